"""The page that shows the remade figures: one HTML file beside its pictures, for light and dark screens."""

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from pathlib import Path


@dataclass(frozen=True)
class Table:
    """Rows of text; numbers are set to the right."""

    head: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


@dataclass(frozen=True)
class Remake:
    """A figure of the paper, made again."""

    number: str
    """The paper's, e.g. "Figures 2 and 3"."""
    title: str
    text: str
    """What is seen and what is measured, in two sentences."""
    made_by: str
    """Rig, pins, seed, settings."""
    images: tuple[tuple[Path, str], ...] = ()
    """Pictures, and what each shows in a few words."""
    table: Table | None = None
    files: tuple[Path, ...] = ()
    """Numbers to go with it."""


def page(title: str, lead: str, sections: Sequence[tuple[str, Sequence[Remake]]], folder: Path) -> str:
    """Return the page that lies in `folder`, with one section for each rig.

    Parameters
    ----------
    title, lead : str
        Heading, and a paragraph below it.
    sections : sequence of (str, sequence of Remake)
        Heading of the section, and its figures; their files lie in `folder` or below it.
    """
    links, body = [], []
    for number, (name, remakes) in enumerate(sections):
        body.append(f'<h2 id="rig{number}">{escape(name)}</h2>')
        inner = []
        for at, remake in enumerate(remakes):
            inner.append(f'<a href="#r{number}f{at}">{escape(remake.number)}</a>')
            body.append(_article(remake, f"r{number}f{at}", folder))
        links.append(f'<li><a href="#rig{number}">{escape(name)}</a><span>{" ".join(inner)}</span></li>')
    return _PAGE.format(
        title=escape(title), lead=escape(lead), links="\n".join(links), body="\n".join(body), style=_STYLE
    )


def _article(remake: Remake, anchor: str, folder: Path) -> str:
    def link(path: Path) -> str:
        return escape(path.relative_to(folder).as_posix(), quote=True)

    lines = [
        f'<article id="{anchor}">',
        f"<h3><b>{escape(remake.number)}</b> {escape(remake.title)}</h3>",
        f"<p>{escape(remake.text)}</p>",
    ]
    for path, caption in remake.images:
        words = escape(caption, quote=True)
        lines.append(
            f'<figure><a href="{link(path)}"><img src="{link(path)}" alt="{words}" loading="lazy"></a>'
            f"<figcaption>{words}</figcaption></figure>"
        )
    if remake.table is not None:
        lines.append(_table(remake.table))
    files = " · ".join(f'<a href="{link(path)}">{escape(path.name)}</a>' for path in remake.files)
    lines.append(f"<footer>{escape(remake.made_by)}{'<br>' if files else ''}{files}</footer>")
    return "\n".join([*lines, "</article>"])


def _table(table: Table) -> str:
    head = "".join(f"<th>{escape(cell)}</th>" for cell in table.head)
    rows = ("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>" for row in table.rows)
    return (
        f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>\n'
        + "\n".join(rows)
        + "\n</tbody></table></div>"
    )


_STYLE = """
:root {
  color-scheme: light dark;
  --ink: #1b1d21; --dim: #62676e; --paper: #fbfbfa; --card: #fff; --line: #e3e4e6; --link: #0067a8;
}
@media (prefers-color-scheme: dark) {
  :root {
    --ink: #e6e7e9; --dim: #9aa0a8; --paper: #16171a; --card: #1f2125; --line: #33363c; --link: #6cb8ee;
  }
}
* { box-sizing: border-box }
body {
  margin: 0 auto; max-width: 70rem; padding: 3.5rem 1.5rem 6rem; background: var(--paper); color: var(--ink);
  font: 1.0625rem/1.6 "Inter", "Roboto", system-ui, -apple-system, "Segoe UI", sans-serif;
}
h1 { margin: 0 0 .6rem; font-size: 2.1rem; line-height: 1.2; letter-spacing: -.02em }
h2 { margin: 4rem 0 1rem; padding-bottom: .4rem; border-bottom: 1px solid var(--line); font-size: 1.5rem }
h3 { margin: 0 0 .4rem; font-size: 1.15rem; font-weight: 500 }
h3 b { margin-right: .5rem; font-weight: 700 }
p { max-width: 46rem; margin: 0 0 1.2rem }
a { color: var(--link); text-decoration: none }
a:hover { text-decoration: underline }
nav ul { margin: 1.6rem 0 0; padding: 0; list-style: none; font-size: .95rem }
nav li {
  display: flex; flex-wrap: wrap; gap: .2rem 1.2rem; padding: .35rem 0; border-top: 1px solid var(--line);
}
nav li > a { min-width: 12rem; font-weight: 600 }
nav span { display: flex; flex-wrap: wrap; gap: 0 1rem }
article { margin: 2.2rem 0 3.5rem; scroll-margin-top: 1rem }
figure { margin: 0 0 1.4rem }
figure a, .wide { display: block; border: 1px solid var(--line); border-radius: .6rem }
figure a { padding: .75rem; background: #fff }
img { display: block; max-width: 100%; height: auto; margin: 0 auto }
img[src$=".svg"] { zoom: 1.2 }
figcaption, footer { margin-top: .5rem; color: var(--dim); font-size: .875rem }
footer { border-left: 3px solid var(--line); padding-left: .8rem }
.wide { overflow-x: auto; margin-bottom: 1.2rem; background: var(--card) }
table { width: 100%; border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums }
th, td { padding: .5rem .8rem; text-align: right; white-space: nowrap; border-top: 1px solid var(--line) }
thead th { border-top: 0; color: var(--dim); font-weight: 600 }
th:first-child, td:first-child { text-align: left }
@media print {
  body { max-width: none; padding: 0 }
  article { break-inside: avoid }
  nav { display: none }
}
"""

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>{style}</style>
</head>
<body>
<header>
<h1>{title}</h1>
<p>{lead}</p>
<nav><ul>
{links}
</ul></nav>
</header>
<main>
{body}
</main>
</body>
</html>
"""
