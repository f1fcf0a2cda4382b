"""What happens in time: simulate, certificates, escapes, load paths, margins."""
