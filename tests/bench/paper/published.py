"""Figures of the paper as published: one core of an Intel i7 at 2.93 GHz.

From: C. Schüller, L. Kavan, D. Panozzo, O. Sorkine-Hornung, Locally Injective Mappings, SGP 2013, Table 1 and the captions
of the figures.
"""

# Iterations · seconds · E · ‖Cv − d‖² on 4844 triangles, Green's strain; the augmented log, not the log, is in the table.
TABLE_1 = {
    ("spline", "plain"): "332 · 12 · 1.22e5 · 3.5e-6",
    ("spline", "+ substepping"): "53 · 2.3 · 1.28e5 · 3.6e-6",
    ("spline", "+ α-update"): "49 · 1.9 · 1.29e5 · 3.6e-22",
    ("auglog", "plain"): "309 · 12 · 1.24e5 · 3.6e-6",
    ("auglog", "+ substepping"): "56 · 2.8 · 1.31e5 · 3.7e-6",
    ("auglog", "+ α-update"): "56 · 2.7 · 1.31e5 · 3.7e-22",
    ("neohookean", "plain"): "2306 · 96 · 6.72e5 · 1e-4",
    ("neohookean", "+ substepping"): "> 20 h",
    ("neohookean", "+ α-update"): "4779 · 238 · 3.40e5 · 2.4e-21",
    "ipopt": "Ipopt 1136 · 1636 · 1.26e5, KNitro 527 · 68 · 1.24e5",
}

# The same on 48,881 triangles, where every interior-point method took more than 20 h.
TABLE_1_LARGE = {
    ("spline", "plain"): "150 · 145 · 0.52e6 · 1.9e15",
    ("spline", "+ substepping"): "614 · 517 · 63.6e6 · 4e-2",
    ("spline", "+ α-update"): "526 · 471 · 75.1e6 · 2.9e-16",
    ("auglog", "plain"): "69 · 69 · 0.08e6 · 2.8e15",
    ("auglog", "+ substepping"): "972 · 831 · 75.4e6 · 2.7e-8",
    ("auglog", "+ α-update"): "555 · 503 · 75.3e6 · 2.5e-16",
    ("neohookean", "plain"): "19 · 15 · 0.02e6 · 2.9e15",
    ("neohookean", "+ substepping"): "17917 · 7.5 h · 46.2e6 · 310",
    ("neohookean", "+ α-update"): "25814 · 5 h · 175e6 · 0.35",
    "ipopt": "> 20 h",
}

# Seconds, iterations and triangles or tetrahedra as the captions say.
FIGURES = {
    "2": "5040 triangles: 5.5 s",
    "Bimba": "11253 triangles: 93 it, 16.3 s",
    "5": "4 it, < 1 s; KNITRO 1512 it, 948 s",
    "13": "Dino, 13052 tetrahedra: 26 it, 7.3 s",
    "14": "tomato, 13500 tetrahedra: 112 it, 208 s",
    "17": "46384 triangles: 172 s",
    "18": "154 it, 6.5 s; Lipman 2012: 2 it of 19.5 s; largest σ₁/σ₂ 69 and 149",
    "19": "512 flips without barrier; residual 2.6e-16",
    "20": "7 turns, β 0.01: 135 inverted without barrier; residual 2.6e-26",
}
