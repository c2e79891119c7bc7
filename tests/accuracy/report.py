"""The page docs/accuracy.md, from the results of rows."""

import random

import rows

MEASURES = (("nn", "NN"), ("ft", "first tier"), ("st", "second tier"),
            ("e", "E"), ("dcg", "DCG"))
RESAMPLES = 2000
NOT_MEASURED = "not measured"

HEAD = """# How accurate

Made by `./run accuracy`; nothing here is written by hand. Every figure is a run of `argmesh evaluate` against a server that holds the collection.

## Protocol
- **Leave one out**: every shape of a collection is the query once and is left out of its own answer; shapes of its class are relevant.
- **Changed copies and pieces**: meshes are changed (`make_variants`) and sent as queries. The shape a query was made from is left out of NN and first tier,
  which ask for the rest of its class; *source first* and *in top 5* ask for that shape itself.
- Defaults everywhere, but the whole ranking is asked for (`limit` 1,000), so that a partial search compares the windows of up to 1,000 shapes, not of 150; it is laid on the best 100 of
  them as always. *Graphs alone* is `--ranking graph`, *default* fuses graphs and signatures, *re-ranked* is `--rerank`, partial searches are `--mode partial`.
- Intervals: 95 %, percentile bootstrap over queries, 2,000 times. They say how much the choice of queries matters, not how another collection would come out.

**Measures** (Shilane et al. 2004), 0 to 1, C the number of relevant shapes. *NN*: the first shape is relevant. *First, second tier*: share of the relevant among
the first C, 2 C. *E*: harmonic mean of precision and recall of the first 32. *DCG*: relevant shapes weighted by 1/log2(rank), over the best possible.

## Data
| | meshes | classes | what |
|---|---|---|---|
| shrec07 | 190 | 19 | half of the labelled Princeton set (SHREC'07 watertight), closed manifolds of 1,000 to 28,000 vertices |
| shrec07-3000 | 190 | 19 | the same, every mesh resampled to 3,000 vertices first: vertex counts alone tell the class in this set |
| psb | 904 | 90 | training half of the Princeton Shape Benchmark, base classes: soup with holes |
| shrec16 | 198 | | shrec07 and 8 whole animals and people; queries are cut or full of holes, in other poses |

**What was tuned on these.** Weights and scales of graphs were chosen on every second mesh of shrec07, what makes the graphs' score of their levels
by looking at both halves of it and at psb; the codebook of signatures was learnt from every second mesh of shrec07 and
psb without classes, the window codebook from half of shrec07; the weight of the graphs in partial searches from every second query;
scales of the default score on every second mesh of shrec07, its weights on every second query of shrec07 and psb. Other collections will come out lower.
"""

PUBLISHED = """## Published figures
For orientation only: they are of all 400 meshes of the SHREC'07 set, 20 a class; ours of half of it, 10 a class. Recalled from the literature and
derived from contest tables, not measured here.

| method | NN | first tier | second tier | DCG |
|---|---|---|---|---|
| PANORAMA (Papadakis 2010) | .957 | .673 | .784 | |
| hybrid 2D/3D (Papadakis 2008) | .955 | .642 | .773 | |
| covariance descriptors (Tabia 2014) | .930 | .623 | .737 | .864 |
| light field descriptors | .923 | .526 | .662 | |
| augmented Reeb graphs (Tung, Schmitt; best of the contest) | | .70 | .82 | |
| words of parts (Toldo 2009) | | .63 | .75 | |
"""

TAIL = """## Again
`./run accuracy` measures what is not measured yet of the binaries as they are and writes this page; `--quick` leaves out the larger collections.
Rows that say *not measured* were not run. The meshes are not part of the project; `ARGMESH_DATA_DIR` names the folder of `shrec07_dev`, `psb_train` and
`shrec16_cuts_dev`, each with a `labels.tsv`.
"""


def number(value):
    text = f"{value:.3f}"
    return text[1:] if text.startswith("0.") else text.replace("-0.", "−.")


def interval(values):
    """The 95 % interval of the mean."""
    source = random.Random(1)
    means = sorted(
        sum(source.choices(values, k=len(values))) / len(values)
        for _ in range(RESAMPLES))
    return means[int(0.025 * RESAMPLES)], means[int(0.975 * RESAMPLES) - 1]


def with_interval(values):
    low, high = interval(values)
    mean = sum(values) / len(values)
    return f"{number(mean)} ({number(low)} to {number(high)})"


def table(head, lines):
    rule = ["---"] * len(head)
    return "".join("| " + " | ".join(line) + " |\n"
                   for line in [head, rule, *lines])


def section(name):
    return [row for row in rows.ROWS if row.section == name]


def column(result, measure):
    return [query[measure] for query in result["per_query"]]


def retrieval(name, results):
    """One collection, leave one out."""
    lines = []
    for row in section(name):
        result = results.get(row.key)
        if result is None:
            lines.append([row.title] + [NOT_MEASURED] + [""] * 4)
            continue
        cells = [with_interval(column(result, key)) if key != "e"
                 else number(result[key]) for key, _ in MEASURES]
        lines.append([row.title] + cells)
    return table(["ranking"] + [title for _, title in MEASURES], lines)


def comparison(pairs, results):
    """Pairs of (title, better, worse): differences query by query."""
    lines = []
    for title, first, second in pairs:
        if first not in results or second not in results:
            lines.append([title, NOT_MEASURED, "", ""])
            continue
        other = {q["query"]: q for q in results[second]["per_query"]}
        both = [(q, other[q["query"]]) for q in results[first]["per_query"]
                if q["query"] in other]
        lines.append([title] + [
            with_interval([a[key] - b[key] for a, b in both])
            for key in ("nn", "ft", "dcg")])
    return table(["difference", "NN", "first tier", "DCG"], lines)


def halves(names, results):
    """Every second query: those that weights were chosen on, and the others."""
    lines = []
    for row in [row for name in names for row in section(name)]:
        result = results.get(row.key)
        if result is None:
            lines.append([row.title, row.collection, NOT_MEASURED] + [""] * 5)
            continue
        cells = []
        for first in (0, 1):
            half = result["per_query"][first::2]
            cells += [number(sum(q[key] for q in half) / len(half))
                      for key in ("nn", "ft", "dcg")]
        lines.append([row.title, row.collection] + cells)
    return table(["ranking", "collection", "odd-numbered: NN", "first tier",
                  "DCG", "even-numbered: NN", "first tier", "DCG"], lines)


def per_class(results):
    keys = [row for row in section("as-is") if row.key in results]
    if not keys:
        return NOT_MEASURED + "\n"
    head = ["class"]
    for row in keys:
        head += [f"{row.title}: NN", "first tier"]
    lines = []
    for name in sorted(results[keys[0].key]["per_class"]):
        line = [name]
        for row in keys:
            measures = results[row.key]["per_class"][name]
            line += [number(measures["nn"]), number(measures["ft"])]
        lines.append(line)
    return table(head, lines)


def made_queries(names, results, verified=False):
    """Queries made from stored shapes; with what was verified."""
    lines = []
    head = ["query", "queries", "class NN", "class first tier",
            "source first", "in top 5"]
    shares = ["source_first", "source_top5"]
    if verified:
        head += ["source verified", "another class verified"]
        shares += ["source_verified", "other_class_verified"]
    for row in [row for name in names for row in section(name)]:
        ranking = "graphs" if "graph" in row.arguments else ""
        title = f"{row.title}, graphs alone" if ranking else row.title
        result = results.get(row.key)
        if result is None:
            lines.append([title, "", NOT_MEASURED] + [""] * (len(head) - 3))
            continue
        cells = [str(result["with_source"])]
        if result["per_query"]:
            cells += [with_interval(column(result, key))
                      for key in ("nn", "ft")]
        else:
            cells += ["", ""]
        cells += [number(result[share]) for share in shares]
        lines.append([title] + cells)
    return table(head, lines)


def render(results):
    failed = sum(result["failed"] for result in results.values())
    pairs = [
        ("default − graphs alone", "shrec07-fused", "shrec07-graph"),
        ("re-ranked − default", "shrec07-reranked", "shrec07-fused"),
        ("resampled − as is, graphs alone", "shrec07-3000-graph",
         "shrec07-graph"),
        ("resampled − as is, default", "shrec07-3000-fused", "shrec07-fused"),
        ("psb: default − graphs alone", "psb-fused", "psb-graph"),
        ("psb: re-ranked − default", "psb-reranked", "psb-fused"),
    ]
    return "\n".join([
        HEAD,
        "## Global: shrec07, as it is\n" + retrieval("as-is", results),
        "## Global: shrec07, resampled to 3,000 vertices\n"
        + retrieval("resampled", results),
        "## Global: psb\n" + retrieval("psb", results),
        "## Compared query by query\n" + comparison(pairs, results),
        "## Half by half\n"
        "Weights were chosen on odd-numbered queries and meshes, so the even-numbered "
        "are the fairer half.\n\n" + halves(["as-is", "psb"], results),
        "## Class by class, shrec07\n" + per_class(results),
        "## Global: changed copies against shrec07\n"
        + made_queries(["changed-fused", "changed-graph"], results),
        "## Partial: pieces against shrec07\n"
        "Copies of pieces are rotated, scaled and moved as well. The collection "
        "holds pairs of identical shapes: about one source in ten may come "
        "second. *Verified*: the answer says that the query was found on the "
        "shape.\n\n"
        + made_queries(["partial", "partial-reranked"], results, True),
        "## Partial: animals with parts missing\n"
        + made_queries(["shrec16"], results, True),
        PUBLISHED,
        f"## Failures\n{failed} queries failed in all rows above.\n",
        TAIL,
    ])
