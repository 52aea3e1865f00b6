#!/usr/bin/env python3
"""versions.py FOLDER: the page of versions in FOLDER, the list that the manual's selector reads, and latest/.

FOLDER has a folder for each version, 0.1, 1.0. latest/ has, for each page of the newest, a page that leads there, with
what the address has behind ? and #.
"""
import html
import json
import re
import sys
from pathlib import Path

leads = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <title>Passo {version}</title>
    <script>location.replace({target} + location.search + location.hash);</script>
    <noscript><meta http-equiv="refresh" content="0; url={address}" /></noscript>
  </head>
  <body><p><a href="{address}">Passo {version}</a></p></body>
</html>
"""
listing = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8" />
    <meta name="viewport" content="width=device-width" />
    <meta name="color-scheme" content="light dark" />
    <title>Versions of Passo</title>
    <link rel="icon" href="{newest}/icon.svg" type="image/svg+xml" />
  </head>
  <body style="font: 1.1rem/1.6 system-ui, sans-serif; max-width: 40rem; margin: 2rem auto; padding: 0 1rem">
    <main>
      <h1>Versions of Passo</h1>
      <p>Each version keeps its manual and its Lab, so links to them stay valid. <a href="latest/index.html">latest</a> leads to the newest.</p>
      <ul>
{items}
      </ul>
    </main>
  </body>
</html>
"""


def leading_to(version, address):
    return leads.format(version=version, address=html.escape(address), target=json.dumps(address))


def main(folder):
    names = [one.name for one in folder.iterdir() if re.fullmatch(r"\d+\.\d+", one.name)]
    versions = sorted(names, key=lambda name: [int(part) for part in name.split(".")], reverse=True)
    if not versions:
        sys.exit(f"versions.py: {folder} has no version, such as 0.1")
    newest = versions[0]
    for old in (folder / "latest").rglob("*.html"):
        old.unlink()
    for page in (folder / newest).rglob("*.html"):
        name = page.relative_to(folder / newest)
        stub = folder / "latest" / name
        stub.parent.mkdir(parents=True, exist_ok=True)
        up = "../" * len(name.parts)
        stub.write_text(leading_to(newest, f"{up}{newest}/{name.as_posix()}"), encoding="utf-8")
    list_of = [{"version": one, "title": one, "aliases": ["latest"] if one == newest else []} for one in versions]
    (folder / "versions.json").write_text(json.dumps(list_of) + "\n", encoding="utf-8")
    items = "\n".join(
        f'        <li><a href="{one}/index.html">{one}</a>: <a href="{one}/manual/installing.html">manual</a>, '
        f'<a href="{one}/lab/index.html">Lab</a></li>'
        for one in versions
    )
    (folder / "versions.html").write_text(listing.format(items=items, newest=newest), encoding="utf-8")
    (folder / "index.html").write_text(leading_to(newest, f"{newest}/index.html"), encoding="utf-8")


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        sys.exit(__doc__)
    main(Path(sys.argv[1]))
