"""What tests of the explorer share."""
