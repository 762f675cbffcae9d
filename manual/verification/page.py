"""The chapter verification.md from its parts."""

import exact_pages


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "| " + " | ".join("---" for _ in heads) + " |"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def picture(name, words):
    return f"![{words}](verification/{name}.svg)"


def opening(summary, machine, quick):
    missed = sum("MISSED" in row[-1] for row in summary)
    goals = sum(row[-1] != "no goal" for row in summary)
    return f"""# Verification

Written by `./run.sh report`{" (quick version: fewer sizes and runs)" if quick else ""}; every number and every figure below is of that one run.
{machine}

Of {goals} goals {goals - missed} are met and {missed} missed. *Measured* is at the size the goal holds for (bold in the tables further down), *order* is the
slope of log error over log size over all sizes, by least squares. Errors of exact cases are against the exact solution, in the norm
that the row names. Goals are those of the project's design; where it sets none the row says so.

{table(exact_pages.HEADS, summary)}

Not there yet: Hertz and Cattaneo-Mindlin (case 9 of the design, needs quadratic faces or far finer meshes) and the measured
Brake-Reuss beam (case 12).

Contents: [Exact cases](#exact-cases) · [Hard cases](#hard-cases) · [Speed against error](#speed-against-error) ·
[Error estimates](#error-estimates)
"""


def exact_section(done, orders_rows):
    parts = ["## Exact cases\n\nGrey is exact, blue computed."]
    for measured in done:
        case = measured.case
        heads, rows = exact_pages.size_table(measured)
        parts.append("\n\n".join(filter(None, [
            f"### {case.number} {case.title}", f"{case.what} `{case.deck}`", f"*Exact:* {case.exact}",
            picture(case.name, case.title), table(heads, rows), case.note])))
    if orders_rows:
        heads = ["series", "size", "1", "2", "3", "4", "order"]
        parts.append("\n\n".join([
            "### 11 Order of convergence", "A smooth pulse (sin^4) runs along a bar; relative L2 error of the displacement over 20 sections "
            "at 0.9 L/c. `decks/verification/orders.lua`", "*Exact:* d'Alembert. *Theory:* 2 in h and dt, 1 in dt with numerical damping.",
            picture("orders", "Orders of convergence"), table(heads, orders_rows)]))
    return "\n\n".join(parts)
