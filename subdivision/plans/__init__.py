"""Many levels at once, by whole arrays: ``plan`` chooses how; whatever it chooses, the outcome is that of the stages.

One step: ``kernels`` (the first), ``later`` (those after it), ``sharp_rows`` (what sharpness changes),
``corner_steps`` (dual schemes), ``middle_steps`` (sqrt(3)), ``butterfly_steps`` and ``butterfly_later``,
``grid_steps`` (interpolating quads).

Many levels: ``tables`` and ``butterfly_tables`` by the kind of a face (``rings``, ``mirrors``, ``sorted_faces``,
``templates``), ``corner_blocks`` by control corner (numbered by ``corner_numbers``), ``middle_tables``, ``grids``;
``poles`` by valence.
"""
