"""The page itself: one file that opens from disk, beside its SVG and CSV files."""

import html
import re

STYLE = """
:root { color-scheme: light; }
body { font: 16px/1.55 system-ui, sans-serif; color: #222; max-width: 54rem; margin: 3rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.8rem; margin-bottom: .2rem; } h2 { font-size: 1.25rem; margin-top: 3rem; }
nav ol { columns: 2; padding-left: 1.2rem; } a { color: #1f5fa8; }
figure { margin: 1rem 0; } figure img { width: 100%; height: auto; }
.says { border-left: 3px solid #1f5fa8; padding-left: .9rem; font-weight: 500; }
.fault { border-left: 3px solid #b00020; padding-left: .9rem; }
code { font-size: .82rem; background: #f4f4f4; padding: .1rem .3rem; border-radius: 3px; overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: .86rem; width: 100%; }
th, td { text-align: left; padding: .25rem .6rem; border-bottom: 1px solid #e4e4e4; vertical-align: top; }
.small { color: #666; font-size: .86rem; }
"""


def cell(value):
    if isinstance(value, float):
        return f"{value:.4g}"
    return html.escape(str(value))


def table(data):
    head = "".join(f"<th>{html.escape(column)}</th>" for column in data.columns)
    rows = "".join("<tr>" + "".join(f"<td>{cell(value)}</td>" for value in row) + "</tr>\n"
                   for row in data.rows)
    return (f"<table><thead><tr>{head}</tr></thead><tbody>\n{rows}</tbody></table>\n"
            f'<p class="small"><a href="{data.name}.csv">{data.name}.csv</a></p>')


def figure(plot):
    alt = html.escape(plot.title)
    return (f'<figure><img src="{plot.name}.svg" alt="{alt}">'
            f'<figcaption class="small"><a href="{plot.name}.csv">{plot.name}.csv</a></figcaption></figure>')


def anchor(title):
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def section(entry):
    """`entry`: title, why, result or None, fault or None, commands, seconds."""
    parts = [f'<h2 id="{anchor(entry.title)}">{html.escape(entry.title)}</h2>',
             f"<p>{html.escape(entry.why)}</p>"]
    if entry.result:
        parts += [figure(plot) for plot in entry.result.plots]
        parts.append(f'<p class="says">{html.escape(entry.result.sentence)}</p>')
        parts += [table(data) for data in entry.result.tables]
    if entry.fault:
        parts.append(f'<p class="fault">Not measured: {html.escape(entry.fault)}</p>')
    commands = "<br>".join(f"<code>{html.escape(command)}</code>" for command in entry.commands)
    parts.append(f'<p class="small">{commands}<br>{entry.seconds:.0f} s</p>')
    return "\n".join(parts)


def write(path, machine, entries):
    contents = "".join(f'<li><a href="#{anchor(e.title)}">{html.escape(e.title)}</a></li>\n'
                       for e in entries)
    facts = "<br>".join(html.escape(line) for line in machine)
    body = "\n".join(section(entry) for entry in entries)
    path.write_text(f"""<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>Peregrine: error against run time</title>
<meta name="viewport" content="width=device-width, initial-scale=1">
<style>{STYLE}</style></head><body>
<h1>Error against run time</h1>
<p class="small">{facts}</p>
<p>Each plot has the price on one axis and the error on the other: lower and farther left is better. A ring marks the
default, the thin line joins what nothing else beats, squares are peers. Sentences are written from the figures of this run.</p>
<nav><ol>
{contents}</ol></nav>
{body}
</body></html>
""", encoding="utf-8")
