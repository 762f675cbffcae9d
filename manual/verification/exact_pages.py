"""Figures, tables and text of the exact cases."""

import csv

import figures
import histories
from cases import SERIES, CASES, measure, measure_orders

HEADS = ["case", "quantity", "goal", "measured", "order", "verdict"]


def number(value, digits=3):
    """A number as one reads it: four figures at most, powers where it is tiny."""
    if value is None or value != value:
        return "-"
    if value == 0:
        return "0"
    return f"{value:.2e}" if abs(value) < 1e-3 or abs(value) >= 1e5 else f"{value:.{digits}g}"


def verdict(goal, missed):
    return "no goal" if goal is None else ("**MISSED**" if missed else "met")


def summary_rows(measured):
    """A row of the summary for each quantity with a goal, or of the first ones where none has any."""
    case, rows = measured.case, []
    for i, quantity in enumerate(case.quantities):
        value, order = measured.at_goal(i), measured.order(i)
        missed = quantity.goal is not None and quantity.missed(value)
        rows.append([f"{case.number} [{case.title}](#{anchor(case)})", quantity.name, quantity.goal_shown(),
                     f"{number(value)} {quantity.unit}".strip(), "-" if order is None else f"{order:.2f}", verdict(quantity.goal, missed)])
    return rows


def anchor(case):
    return f"{case.number}-{case.title}".lower().replace(" ", "-").replace("'", "")


def write_csv(path, measured):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([measured.case.knob] + [f"{q.name} [{q.unit}]" if q.unit else q.name for q in measured.case.quantities])
        for row, (label, _) in enumerate(measured.case.sizes):
            writer.writerow([label] + [f"{values[row]:.6g}" for values in measured.values])


def size_table(measured):
    """One row a quantity, one column a size; the size that goals hold for in bold."""
    case = measured.case
    heads = [case.knob] + [f"**{label}**" if i == case.goal_at else label for i, (label, _) in enumerate(case.sizes)]
    rows = []
    for quantity, values in zip(case.quantities, measured.values):
        rows.append([quantity.name + (f" ({quantity.unit})" if quantity.unit else "")] + [number(v) for v in values])
    return heads, rows


def solver_table(measured):
    """One row a quantity, one column a solver, at the size of the goals; None where only one solver ran."""
    if not measured.others:
        return None
    case = measured.case
    rows = []
    for i, quantity in enumerate(case.quantities):
        values = [measured.at_goal(i)] + [values[i] for values in measured.others.values()]
        rows.append([quantity.name + (f" ({quantity.unit})" if quantity.unit else ""), quantity.goal_shown()] +
                    [number(v) + (" !" if quantity.goal is not None and quantity.missed(v) else "") for v in values])
    return [f"{case.knob} = {case.sizes[case.goal_at][0]}", "goal", "the deck's own"] + list(measured.others), rows


def exact_cases(program, folder, say, only=None):
    """Runs the exact cases, writes their figures and CSV; answers [(Measured, ...)] in order."""
    done = []
    for case in CASES:
        if only and case.name != only:
            continue
        measured = measure(case, program, say)
        write_csv(folder / f"{case.name}.csv", measured)
        history = getattr(histories, case.history) if case.history else None
        figures.save(figures.case_figure(measured, history), folder / f"{case.name}.svg")
        done.append(measured)
    return done


def orders(program, folder, say):
    """Orders of convergence on the smooth pulse: rows for the summary and for the table, and the figure."""
    _, found = measure_orders(program, say)
    figure, axes = figures.plt.subplots(1, 2, figsize=(8.2, 2.9))
    figure.subplots_adjust(wspace=0.75)
    ends, rows, summary = ([], []), [], []
    with open(folder / "orders.csv", "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["series", "size", "error"])
        for k, (series, (name, theory, sizes, x)) in enumerate(SERIES.items()):
            errors, order = found[series]
            writer.writerows([series, n, f"{e:.6g}"] for n, e in zip(sizes, errors))
            panel = 0 if series.startswith("h") else 1
            inverse = [1 / n for n in sizes]
            axes[panel].loglog(inverse, errors, color=figures.COLOURS[k], marker=figures.MARKERS[k])
            ends[panel].append((inverse[0], errors[0], f"{name.split(', ')[1].replace('numerical ', '')}, slope {order:.2f}", figures.COLOURS[k]))
            missed = abs(order - theory) > 0.1
            rows.append([name, x] + [f"{n}: {number(e)}" for n, e in zip(sizes, errors)] + [f"{order:.2f}"])
            summary.append(["11 [Order of convergence](#11-order-of-convergence)", name, f"{theory} within 0.1", f"{order:.2f}", f"{order:.2f}",
                            verdict(theory, missed)])
    axes[1].set_xlim(right=0.05)
    for a, title, sizes, label, panel_ends in zip(axes, ("relative L2 error against the mesh", "against the time step"),
                                                  ([40, 80, 160, 320], [30, 60, 120, 240, 480, 960]), ("cells n", "time steps"), ends):
        a.set_title(title)
        figures.sized_ticks(a, [1 / n for n in sizes], [str(n) for n in sizes], label)
        a.figure.canvas.draw()
        figures.direct_labels(a, panel_ends)
    figures.save(figure, folder / "orders.svg")
    return summary, rows
