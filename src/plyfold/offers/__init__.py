"""What to do about a "no"."""
