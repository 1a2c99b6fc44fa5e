"""Lessons of one's own: kept apart, tried before they run, and written down from what is on the screen."""
