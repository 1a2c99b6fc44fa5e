"""The laboratory: any object under rules of the user's choice, and all that changes it."""
