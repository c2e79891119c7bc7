"""What is measured: collections, queries, and the rows made of both.

Rows are measured in this order. A row is one run of `argmesh evaluate`; its
`queries` name an entry of CHANGES, or None for leave-one-out.
"""

from typing import NamedTuple, Optional


class Collection(NamedTuple):
    source: str  # folder of the data with a labels.tsv
    variant: tuple = ()  # make_variants options that change every mesh first
    more: tuple = ()  # (folder, ..) stored beside it without a class


class Row(NamedTuple):
    section: str
    key: str  # unique; the name of the result file
    title: str
    collection: str
    arguments: tuple
    queries: Optional[str] = None
    quick: bool = True  # part of --quick


COLLECTIONS = {
    "shrec07": Collection("shrec07_dev"),
    "shrec07-3000": Collection("shrec07_dev", ("--resample", "3000")),
    "psb": Collection("psb_train"),
    "shrec16": Collection("shrec07_dev", (), ("shrec16_cuts_dev/null",)),
}

# Name: (folder, make_variants options, every n-th mesh).
CHANGES = {
    "similarity": ("shrec07_dev", ("--similarity",), 5),
    "noise-0.5": ("shrec07_dev", ("--noise", "0.005"), 5),
    "noise-1": ("shrec07_dev", ("--noise", "0.01"), 5),
    "decimated-50": ("shrec07_dev", ("--decimate", "0.5"), 5),
    "decimated-25": ("shrec07_dev", ("--decimate", "0.25"), 5),
    "decimated-10": ("shrec07_dev", ("--decimate", "0.1"), 5),
    "parts": (
        "shrec07_dev",
        ("--similarity", "--parts", "--min-part-area", "0.05"),
        3,
    ),
    "half-x": ("shrec07_dev", ("--similarity", "--half", "0"), 3),
    "half-y": ("shrec07_dev", ("--similarity", "--half", "1"), 3),
    "half-z": ("shrec07_dev", ("--similarity", "--half", "2"), 3),
    "piece-30": (
        "shrec07_dev",
        ("--similarity", "--piece", "0.3", "--resample", "2000",
         "--size-noise", "0.003"),
        3,
    ),
    "disc": (
        "shrec07_dev",
        ("--similarity", "--disc", "0.12"),
        5,
    ),
    "cuts": (
        "shrec16_cuts_dev",
        ("--only", "cuts/", "--source-prefix", "null/"),
        1,
    ),
    "holes": (
        "shrec16_cuts_dev",
        ("--only", "holes/", "--source-prefix", "null/"),
        1,
    ),
}

GRAPH = ("--mode", "global", "--ranking", "graph")
FUSED = ("--mode", "global")
RERANKED = ("--mode", "global", "--rerank")
PARTIAL = ("--mode", "partial")
PARTIAL_RERANKED = ("--mode", "partial", "--rerank")

# (key, title) of a change and what it does.
WHOLE = (
    ("similarity", "rotated, scaled, moved, renumbered"),
    ("noise-0.5", "noise of .5 % of the box diagonal"),
    ("noise-1", "noise of 1 %"),
    ("decimated-50", "half of the vertices"),
    ("decimated-25", "a quarter of the vertices"),
    ("decimated-10", "a tenth of the vertices"),
)
PIECES = (
    ("parts", "hand-made part of 5 % or more"),
    ("half-x", "half, cut across x"),
    ("half-y", "half, cut across y"),
    ("half-z", "half, cut across z"),
    ("piece-30", "30 % cut off by a random plane, 2,000 vertices, .3 % noise"),
)
# Too featureless to say what it is a part of.
DISC = (("disc", "flattest disc of 60, radius .12 of the shape's size"),)


def _whole(section, collection, quick=True):
    return [
        Row(section, f"{collection}-graph", "graphs alone", collection, GRAPH,
            None, quick),
        Row(section, f"{collection}-fused", "default", collection, FUSED, None,
            quick),
        Row(section, f"{collection}-reranked", "default, re-ranked",
            collection, RERANKED, None, quick),
    ]


ROWS = (
    _whole("as-is", "shrec07")
    + [Row("changed-fused", f"fused-{key}", title, "shrec07", FUSED, key)
       for key, title in WHOLE]
    + [Row("changed-graph", f"graph-{key}", title, "shrec07", GRAPH, key,
           False) for key, title in WHOLE]
    + [Row("partial", f"partial-{key}", title, "shrec07", PARTIAL, key)
       for key, title in PIECES + DISC]
    + [Row("partial-reranked", f"partial-reranked-{key}",
           f"{title}, re-ranked", "shrec07", PARTIAL_RERANKED, key)
       for key, title in PIECES]
    + _whole("resampled", "shrec07-3000", False)
    + [Row("shrec16", f"partial-{key}", f"animals with {key}, other poses",
           "shrec16", PARTIAL, key, False) for key in ("cuts", "holes")]
    + _whole("psb", "psb", False)
)
