"""A model's MJCF with other numbers in it: attributes are changed in the user's own text, the rest stays as it is."""
