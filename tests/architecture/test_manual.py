"""Links of the manual: every page is in the nav of mkdocs.yml, every link and anchor leads somewhere. No mkdocs needed."""

import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MANUAL = ROOT / "manual"
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^\s*```")


def prose(path):
    """Lines of a page that are no code: neither fenced nor indented as such, code spans blanked."""
    is_fenced = False
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if FENCE.match(line):
            is_fenced = not is_fenced
            continue
        if not is_fenced and not (line.startswith("    ") and not re.match(r"\s*([-*|]|\d+\.)\s", line)):
            yield number, line


def slug(heading):
    """As both Python-Markdown and GitHub make it."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading.strip())
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", text).strip().lower())


def anchors(path):
    found = []
    for _, line in prose(path):
        found += re.findall(r'<a (?:id|name)="([^"]+)"', line)
        heading = re.match(r"#{1,6}\s+(.*)", line)
        if not heading:
            continue
        base, name, n = slug(heading[1]), slug(heading[1]), 0
        while name in found:
            n += 1
            name = f"{base}_{n}"
        found.append(name)
    return set(found)


def faults_of(path, known):
    for number, line in prose(path):
        for target in LINK.findall(re.sub(r"`[^`]*`", "", line)):
            if re.match(r"[a-z]+:", target):
                continue
            file, _, anchor = target.partition("#")
            there = (path.parent / file).resolve() if file else path
            where = f"{path.relative_to(ROOT)}:{number}: {target}"
            if not there.exists():
                yield f"{where}: no such file"
            elif anchor and there.suffix == ".md" and anchor not in known.setdefault(there, anchors(there)):
                yield f"{where}: no such heading"
            elif path.is_relative_to(MANUAL) and not there.is_relative_to(MANUAL):
                yield f"{where}: outside of the manual, and so of its site"


def main():
    pages = sorted(MANUAL.rglob("*.md"))
    known, faults = {}, []
    for path in pages + [ROOT / "README.md", ROOT / "CONTRIBUTING.md"]:
        faults += faults_of(path, known)
    listed = re.findall(r":\s+(\S+\.md)$", (ROOT / "mkdocs.yml").read_text(), re.M)
    present = [page.relative_to(MANUAL).as_posix() for page in pages]
    faults += [f"mkdocs.yml: no page {name}" for name in listed if name not in present]
    faults += [f"mkdocs.yml: {name} is listed {listed.count(name)} times" for name in present if listed.count(name) != 1]
    assert len(pages) > 20 and slug("Is the *result* good?") == "is-the-result-good"
    print("\n".join(faults) or f"{len(pages)} pages, all links and anchors lead somewhere")
    sys.exit(1 if faults else 0)


main()
