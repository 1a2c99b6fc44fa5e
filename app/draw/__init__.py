"""From values to pictures: ``compose`` decides, ``vtk`` and ``vector`` paint.  No Qt here."""
