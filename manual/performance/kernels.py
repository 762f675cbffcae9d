"""Kernels against what the machine allows: read bandwidth and dgemm of the same run."""

import figures
from measure import write_rows
from page import table

SIZES = {12: "6.6k", 19: "24k", 31: "98k"}
SHAPES = ["hex8 boxes", "hex8 distorted", "prism6 distorted", "tet4 distorted"]
ASSEMBLY = ["shape:0/cubes:64/threads:1", "shape:1/cubes:64/threads:1", "shape:1/cubes:64/threads:2", "shape:2/cubes:40/threads:1",
            "shape:3/cubes:32/threads:1"]


def measure(machine, folder, quick):
    """Runs bench_kernels and writes kernels.csv: one row a quantity, with the probe it is held against."""
    cells = [12, 19] if quick else list(SIZES)
    sizes = "|".join(map(str, cells))
    probes = "16|34|92" if quick else "16|34|92|137|664|3072"
    pattern = (f"(read_bandwidth/MiB:({probes})/)|dgemm|((factor|solve_one/double|solve_one/single|solve_several/double|solve_several/single|solve_cholmod)/cells:({sizes})(/|$))|"
               "interface_operator|assembly")
    machine.say("Kernels")
    found = machine.kernels(pattern, 0.1 if quick else 0.5)
    rows = []

    def add(what, size, value, unit, probe="", allowed=0.0):
        rows.append({"kernel": what, "size": size, "value": value, "unit": unit, "probe": probe, "allowed": allowed,
                     "share": value / allowed if allowed else 0.0})

    for name, b in found.items():
        if name.startswith("read_bandwidth"):
            _, mib, threads = [part.split(":")[-1] for part in name.split("/")]
            add("read bandwidth", f"{mib} MiB, {threads} thread{'s' * (threads != '1')}", b["bytes/s"] / 1e9, "GB/s")
    gemm = {t: found[f"dgemm/n:1500/threads:{t}"]["flop/s"] / 1e9 for t in (1, 2)}
    for threads, value in gemm.items():
        add("dgemm", f"{threads} thread{'s' * (threads > 1)}", value, "GF/s")
    bandwidth = {float(r["size"].split()[0]): r["value"] for r in rows if r["kernel"] == "read bandwidth" and r["size"].endswith("1 thread")}

    def nearest(mib):
        """Bandwidth of one thread on an array of about that size: caches may hold it."""
        size = min(bandwidth, key=lambda s: abs(s - mib))
        return f"read, {size:g} MiB", bandwidth[size]

    for n in cells:
        b, dof = found[f"factor/cells:{n}"], SIZES[n]
        add("factor", dof, b["flop/s"] / 1e9, "GF/s", "dgemm", gemm[1])
        add("ordering", dof, b["ordering_s"], "s")
        mib = b["MiB"]
        add("size of the factor", dof, mib, "MiB")
        add("forward and backward", dof, found[f"solve_one/double/cells:{n}"]["bytes/s"] / 1e9, "GB/s", *nearest(mib))
        single = found[f"solve_one/single/cells:{n}"]
        add("the same, stored in single precision", dof, single["bytes/s"] / 1e9, "GB/s", *nearest(mib * single["bytes per entry"] / 8))
        add("bytes per entry, stored in single precision", dof, single["bytes per entry"], "bytes")
        add("the same by cholmod_solve2", dof, found[f"solve_cholmod/cells:{n}/columns:1"]["bytes/s"] / 1e9, "GB/s", *nearest(mib))
        several = found[f"solve_several/double/cells:{n}/columns:16"]
        add(f"16 right-hand sides, {several['label']}", dof, several["flop/s"] / 1e9, "GF/s", "dgemm", gemm[1])
        add("16 together, stored in single precision", dof, found[f"solve_several/single/cells:{n}/columns:16"]["flop/s"] / 1e9, "GF/s", "dgemm", gemm[1])
        add("the same by cholmod_solve2, 16 together", dof, found[f"solve_cholmod/cells:{n}/columns:16"]["flop/s"] / 1e9, "GF/s", "dgemm", gemm[1])
        for stored in ("double", "single"):
            add(f"milliseconds per solve, stored in {stored} precision", dof, found[f"solve_one/{stored}/cells:{n}"]["cpu_time"], "ms")
    for n in (2048, 6000):
        add("interface operator", f"{n} unknowns", found[f"interface_operator/n:{n}"]["bytes/s"] / 1e9, "GB/s", *nearest(4 * n * n / 2**20))
    for name in ASSEMBLY:
        b = found["assembly/" + name]
        threads = name[-1]
        add("assembly", f"{b['label']}, {threads} thread{'s' * (threads != '1')}", b["s/Mcell"], "s per million cells")
    write_rows(folder / "kernels.csv", rows)


def find(rows, kernel, size):
    """The row of a kernel whose size begins so; None where it was not measured."""
    return next((r for r in rows if str(r["kernel"]).startswith(kernel) and str(r["size"]).startswith(size)), None)


def goals(rows):
    """[(goal, measured, met, what bounds it)]"""
    done = []
    largest = [s for s in SIZES.values() if find(rows, "factor", s)][-1]
    for kernel, limit, words, why in [
            ("forward and backward", 0.9, "one right-hand side, of plain read bandwidth", "short columns and scattered rows of small supernodes"),
            ("16 right-hand sides", 0.5, "sixteen right-hand sides, of dgemm", "entries come from memory slower than the products need them"),
            ("16 together, stored in single precision", 0.5, "the same, stored in single precision", "turning stored bits into numbers"),
            ("factor", 0.6, "factor, of dgemm", "small supernodes at the bottom of the tree, the assembly of updates, and packing")]:
        r = find(rows, kernel, largest)
        done.append((f"{words}, {largest} unknowns: at least {limit}", f"{r['share']:.2f}", r["share"] >= limit, why))
    for shape in ("hex8 boxes", "hex8 distorted"):
        r = find(rows, "assembly", f"{shape}, 1")
        done.append((f"assembly, {shape}, one thread: at most 2 s per million cells", f"{r['value']:.2f}", r["value"] <= 2,
                     "clearing the pages of the matrix, element kernel and scatter about equally"))
    return done


def figure(rows, folder):
    picked = [r for r in rows if r["allowed"]]
    picture, axes = figures.plt.subplots(figsize=(7.2, 0.24 * len(picked) + 0.8))
    names = [f"{r['kernel']}, {r['size']}" for r in picked]
    axes.barh(names[::-1], [r["share"] for r in picked][::-1], color=figures.COMPUTED, height=0.65)
    axes.axvline(1.0, color=figures.EXACT)
    axes.set_title("share of what the machine allows (read bandwidth or dgemm, one thread, same run)")
    axes.grid(axis="y", visible=False)
    figures.save(picture, folder / "kernels.svg")


def section(rows):
    cells = [(r["kernel"], r["size"], f"{r['value']:.3g} {r['unit']}", f"{r['allowed']:.3g} ({r['probe']})" if r["allowed"] else "",
              f"{r['share']:.2f}" if r["allowed"] else "") for r in rows]
    return "\n\n".join([
        "## Kernels", "Probes and kernels in one process; processor time where they run on one thread, elapsed time on two. *Read bandwidth* sums an array of that size: where the "
        "caches hold it, it is that of the caches. A solve reads the factor twice (once down, once up); bytes and operations count the entries of L. "
        "Sizes are cubes of hexahedra in a time step at CFL 1; factors are in METIS's order by nodes.",
        "![Kernels against the machine](performance/kernels.svg)", table(["kernel", "size", "measured", "allowed", "share"], cells)])
