"""Problems as equations: the contract, systems, bordered solves, Newton, differences."""
