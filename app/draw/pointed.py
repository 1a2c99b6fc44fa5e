"""What is pointed out: a row of a product of stages, and where it stands in its trace."""

from dataclasses import dataclass

from subdivision import Stencil


@dataclass(frozen=True)
class Pointed:
    """A row to point out: its point after ``stage`` stages, its contributors ``span`` stages before."""

    stencil: Stencil
    stage: int
    span: int
