"""The chapter verification.md from its parts."""

import effectivity
import exact_pages
import hard
import speed


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "| " + " | ".join("---" for _ in heads) + " |"]
    return "\n".join(lines + ["| " + " | ".join(str(cell) for cell in row) + " |" for row in rows])


def picture(name, words):
    return f"![{words}](verification/{name}.svg)"


def opening(summary, machine, quick):
    missed = sum("MISSED" in row[-1] for row in summary)
    goals = sum(row[-1] != "no goal" for row in summary)
    return f"""# Verification

Written by `./run.sh report`{" (quick version: fewer sizes and runs)" if quick else ""}. All numbers and figures come from that run, unless a section states that it keeps those of an earlier one.
{machine}

Of {goals} goals {goals - missed} are met and {missed} missed. *Measured* is the value at the size to which the goal applies (bold in the tables below). *Order* is the
least-squares slope of log error against log size. Errors of exact cases are relative to the exact solution, in the norm
that the row names. Goals come from the project's design; a row states where there is none.

{table(exact_pages.HEADS, summary)}

The measured Brake-Reuss beam has [a page of its own](measured-joints.md).

Contents: [Exact cases](#exact-cases) · [Hard cases](#hard-cases) · [Speed against error](#speed-against-error) ·
[Error estimates](#error-estimates)
"""


def exact_section(done, orders_rows):
    parts = ["## Exact cases\n\nGrey is exact, blue computed."]
    for measured in done:
        case = measured.case
        heads, rows = exact_pages.size_table(measured)
        solvers = exact_pages.solver_table(measured)
        parts.append("\n\n".join(filter(None, [
            f"### {case.number} {case.title}", f"{case.what} `{case.deck}`", f"*Exact:* {case.exact}",
            picture(case.name, case.title), table(heads, rows), case.note,
            solvers and "With the deck's own solver and with others (`!`: misses the goal; solvers as in [speed](#speed-against-error)):",
            solvers and table(*solvers)])))
    if orders_rows:
        heads = ["series", "size", "1", "2", "3", "4", "order"]
        parts.append("\n\n".join([
            "### 11 Order of convergence", "A smooth pulse (sin^4) runs along a bar; relative L2 error of the displacement over 20 sections "
            "at 0.9 L/c. `decks/verification/orders.lua`", "*Exact:* d'Alembert. *Theory:* 2 in h and dt, 1 in dt with numerical damping.",
            picture("orders", "Orders of convergence"), table(heads, orders_rows)]))
    return "\n\n".join(parts)


def hard_section(outcomes):
    n_missed = sum(bool(o.complaints) for o in outcomes)
    said = sum(o.said.startswith("says") for o in outcomes)
    return "\n\n".join([
        "## Hard cases", "Each must converge or report that it did not (exit code 1). None may return a NaN, gain more than "
        f"{hard.CREATED_GOAL} % of energy, hang, or penetrate by more than v dt/2 of its fastest impact. Of {len(outcomes)} variants "
        f"{len(outcomes) - n_missed} do and {n_missed} do not; {said} say that some steps did not converge. Decks are in `decks/hard/`.",
        picture("hard", "Hard cases: iterations, energy created, penetration"),
        "*Red:* a goal is missed. *Orange:* met, and the run says that it did not converge. Energy below 1e-6 % is drawn there.",
        table(hard.HEADS, hard.rows(outcomes))])


def speed_section(done, kept):
    parts = ["## Speed against error", "All solvers and settings ran on one machine in one command, on one thread each. Cost is the processor "
             "time of all phases of run.json except output (the median of three runs below one second); error is the relative L2 error in time of the quantity of interest. "
             "*mesh*: cells and dt together; *dt* alone; *tolerance* of the iteration; *window*: steps iterated together (1, 5, 20); explicit: fraction of "
             "the critical step (*safety*) and stiffness of contact (*penalty*). The tables give the cheapest setting that reaches an error; `-`: none that was "
             "tried does. All runs are in [speed.csv](verification/speed.csv)."]
    options = dict.fromkeys((r.solver, r.option) for _, rows, _ in done for r in rows if r.knob == "mesh")
    parts.append("Solvers: " + "; ".join(f"*{name}*: `{option}`" for name, option in options if option) + ".")
    if kept:
        knows = any(r.solver == "latin implicit" for _, rows, _ in done for r in rows)
        parts.append("The runs of this section come from an earlier command, all others from the last one"
                     + ("." if knows else "; in them `latin` integrated implicitly throughout."))
    parts.append(speed.balance(done))
    for scene, rows, told in done:
        parts += [f"### {scene.title}", f"`{scene.deck}`. {told}", picture(f"speed_{scene.name}", scene.title),
                  f"{speed.against_latin(rows)} {scene.why}"]
        for panel, quantity in enumerate(scene.quantities):
            heads, cells = speed.cheapest(rows, panel)
            parts.append(table([quantity] + heads[1:], cells))
        failed = [f"{r.solver} {r.knob} {r.value} (exit code {r.exit_code})" for r in rows if r.exit_code != 0]
        if failed:
            parts.append("Not converged or failed: " + ", ".join(failed) + ".")
    return "\n\n".join(parts)


def estimates_section(rows):
    parts = ["## Error estimates", "Every run estimates its own errors (`figures` in run.json, the lines *estimated errors*). They are compared here "
             "with true errors in the same norm (energy, worst instant): the iteration with a run at a tolerance of 1e-11, the time step with dt/16, "
             "the mesh with cells 8 times shorter. The scenes of `tests/bench/scenes.lua` (static, frequency, amplitude, spectrum; "
             "`build/release/tests/effectivity scenes`) separate frequency from amplitude, against dt/4 and cells 3 times shorter: the time axis of the finer run is "
             "stretched until its velocities match best, and the remaining distance is the amplitude error; the frequency error is the stretch at which "
             "both runs match best near the mean frequency that the run reports. In impedance, block on bar, pushed block, cap on posts, lapped plates and "
             "falling block, contact closes, opens or slides, as the run reports: "
             "a comparison of frequencies means little there (in the last the remaining distance is as large as the motion), "
             "and the estimates are orders of magnitude."]
    if rows is None:
        return "\n\n".join(parts + ["This program has none, or its study was not built."])
    return "\n\n".join(parts + [effectivity.worst(rows), picture("effectivity", "Estimated against true errors"),
                                "Grey: estimated as it is. Above the diagonal an estimate is on the safe side.",
                                table(effectivity.HEADS, effectivity.shown(rows))])
