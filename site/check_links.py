#!/usr/bin/env python3
"""check_links.py FOLDER: every link of the pages in FOLDER leads to a file in it, and to an element that exists.

It also names each request to another host: a page loads nothing from elsewhere.
"""
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

loads = {("img", "src"), ("script", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.ids, self.links = set(), []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag, name) == ("a", "name"):
                self.ids.add(value)
            elif name in ("href", "src") and value is not None:
                self.links.append((self.getpos()[0], tag, name, value))


def main(folder):
    pages = {path: Page(path) for path in sorted(folder.rglob("*.html"))}
    errors, checked = [], 0
    for path, page in pages.items():
        for line, tag, name, link in page.links:
            parts = urlsplit(link)
            where = f"{path.relative_to(folder)}:{line}: {link}"
            if parts.scheme or parts.netloc:
                if (tag, name) in loads and parts.scheme != "data":
                    errors.append(f"{where}: loaded from another host")
                continue
            checked += 1
            target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
            if target.is_dir():
                target = target / "index.html"
            if not target.is_file() or not target.is_relative_to(folder):
                errors.append(f"{where}: no such file")
            elif parts.fragment and not parts.fragment.startswith("/") and target in pages:  # "#/": the view of a page
                if unquote(parts.fragment) not in pages[target].ids:
                    errors.append(f"{where}: no such heading")
    print(*errors, sep="\n", end="\n" if errors else "")
    print(f"{checked} links in {len(pages)} pages, {len(errors)} wrong")
    return 1 if errors or checked == 0 else 0


if __name__ == "__main__":
    if len(sys.argv) != 2 or not Path(sys.argv[1]).is_dir():
        sys.exit(__doc__)
    sys.exit(main(Path(sys.argv[1]).resolve()))
