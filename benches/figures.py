#!/usr/bin/env python3
"""Tables that the docs take from the pages in benches/results, written between marks:

    <!-- from benches/results/estimates.md: set = cc24 | camera | facet noise | RMSE -->
    ...
    <!-- end -->

After the colon stand the columns, as the page names them (of two with one name the first); a column with `=` is not shown: only rows that have
this value in it, or one of several with ` or ` between them, in the order of the page. `page.md#Heading` is the table below that heading.

    figures.py           writes all of them anew
    figures.py --check   says which are not what the pages say, and changes nothing
"""

import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MARKED = re.compile(r"(<!-- from (benches/results/[^:#]+)(?:#([^:]+))?: (.+?) -->\n)(.*?)(<!-- end -->)", re.DOTALL)
FOLDERS = ["*.md", "docs/**/*.md", "examples/**/*.md"]


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def table(page, heading):
    """Names of columns, and rows, of a page's first table, or of the first below a heading."""
    lines = (ROOT / page).read_text(encoding="utf-8").splitlines()
    first = next((n for n, line in enumerate(lines) if line.lstrip("# ") == heading), None) if heading else 0
    if first is None:
        sys.exit(f"figures.py: {page} has no heading '{heading}'")
    begin = next(n for n, line in enumerate(lines) if n >= first and line.startswith("|"))
    end = next((n for n, line in enumerate(lines) if n > begin and not line.startswith("|")), len(lines))
    return cells(lines[begin]), [cells(line) for line in lines[begin + 2 : end]]


def shown(page, heading, what):
    """The table that a mark asks for."""
    names, rows = table(page, heading)

    def place(name):
        if name not in names:
            sys.exit(f"figures.py: {page} has no column '{name}', but {', '.join(names)}")
        return names.index(name)

    columns = []
    for part in what.split(" | "):
        name, condition, values = part.partition(" = ")
        if condition:
            wanted = values.split(" or ")
            missing = set(wanted) - {row[place(name)] for row in rows}
            if missing:
                sys.exit(f"figures.py: {page} has no row with {name} = {', '.join(sorted(missing))}")
            rows = [row for row in rows if row[place(name)] in wanted]
        else:
            columns.append(place(name))
    lines = [[names[n] for n in columns], ["---"] * len(columns), *([row[n] for n in columns] for row in rows)]
    rule = "|" + "---|" * len(columns)
    return "\n".join(rule if line[0] == "---" else f"| {' | '.join(line)} |" for line in lines)


def main(*flags):
    stale = []
    for path in sorted({path for folder in FOLDERS for path in ROOT.glob(folder)}):
        text = path.read_text(encoding="utf-8")
        anew = MARKED.sub(lambda at: f"{at[1]}\n{shown(at[2], at[3], at[4])}\n\n{at[6]}", text)
        if text.count("<!-- from ") != len(MARKED.findall(text)):
            sys.exit(f"figures.py: {path.relative_to(ROOT)} has a mark that is not read; see --help in the script's first lines")
        if text != anew:
            stale.append(str(path.relative_to(ROOT)))
            if "--check" not in flags:
                path.write_text(anew, encoding="utf-8")
    if stale:
        print("\n".join(stale))
    return "--check" in flags and bool(stale)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
