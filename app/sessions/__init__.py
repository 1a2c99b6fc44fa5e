"""A state as a file or a link, and what is opened from either."""
