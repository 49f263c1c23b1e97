"""All figures, in the order of the paper."""
import barriers
import charts
import edits
import plane
import solids
import steps
import twist

MODULES = plane, charts, barriers, solids, steps, edits, twist

FIGURES = sorted((figure for module in MODULES for figure in module.FIGURES), key=lambda figure: figure.number)
