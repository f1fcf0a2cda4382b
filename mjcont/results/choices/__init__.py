"""What was chosen so that a mechanism does what is wanted: controls that hold a pose, designs that meet targets."""
