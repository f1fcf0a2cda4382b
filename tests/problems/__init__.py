"""Problems that several test files share."""
