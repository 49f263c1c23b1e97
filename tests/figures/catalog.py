"""All figures, in the order of the paper."""
import barriers
import charts
import edits
import plane
import solids
import steps
import twist

FIGURES = sorted(plane.FIGURES + charts.FIGURES + barriers.FIGURES + solids.FIGURES + steps.FIGURES + edits.FIGURES + twist.FIGURES, key=lambda figure: figure.number)
