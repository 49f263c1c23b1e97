"""All figures, in the order of the paper."""
import barriers
import charts
import plane
import solids
import steps

FIGURES = sorted(plane.FIGURES + charts.FIGURES + barriers.FIGURES + solids.FIGURES + steps.FIGURES, key=lambda figure: figure.number)
