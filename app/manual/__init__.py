"""The manual: chapters that were written, and chapters that the program tells of itself."""
