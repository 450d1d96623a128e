"""Figure 1: block and spring between loader plate and rough surface (a drawing, no data)."""

from scripts.plans.declare import MAIN, Figure, Study

STUDY = Study(figures=(Figure("figure_1", category=MAIN, place=10),))
