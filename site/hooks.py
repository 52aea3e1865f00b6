"""What mkdocs does not do by itself: it reads Markdown as GitHub does, so that docs/ need not be written for two parsers.

Links lead from page to page as in the checkout. A link to a source file leads to its text in source/. A link to the lab of
a running server leads to the Lab of the site. Pages that lie elsewhere in the checkout are listed in `elsewhere`.
"""
import html
import json
import os
import posixpath
import re
from pathlib import Path
from urllib.parse import unquote

import jieba
from markdown_it import MarkdownIt
from mkdocs.exceptions import PluginError
from mkdocs.plugins import event_priority
from mkdocs.structure.files import File
from mkdocs.structure.nav import Link
from mkdocs.structure.toc import get_toc
from pygments import highlight
from pygments.formatters import HtmlFormatter
from pygments.lexers import get_lexer_by_name
from pygments.util import ClassNotFound

root = Path(__file__).resolve().parent.parent
elsewhere = {  # the page's name: its file in the checkout
    "index.md": "site/start.md",
    "changelog.md": "CHANGELOG.md",
    "contributing.md": "CONTRIBUTING.md",
    "security.md": "SECURITY.md",
    "conduct.md": "CODE_OF_CONDUCT.md",
    "site.css": "site/site.css",
    "site.js": "site/site.js",
    "icon.svg": "page/public/icon.svg",
}
name_of = {path: name for name, path in elsewhere.items()} | {"README.md": "index.md"}
local_lab = re.compile(r"http://127\.0\.0\.1:7080/?#/lab")
built_pages = Path(os.environ.get("PASSO_SITE_PAGES", root / "build/site-pages"))
pages_of_their_own = {"lab": "Lab", "check": "Check a program"}
longest_term = 4  # characters of a Chinese term that is a heading
longest_summary = 300  # characters
sources = set()  # source files that a page links to


def on_files(files, config):
    for name, path in elsewhere.items():
        file = File(name, str(root), config["site_dir"], config["use_directory_urls"])
        file.abs_src_path = str(root / path)
        files.append(file)
    return files


def on_nav(nav, config, files):
    in_nav = {page.file.src_uri for page in nav.pages}
    for file in files.documentation_pages():
        if file.src_uri not in in_nav and not file.src_uri.startswith("decisions/"):
            raise PluginError(f"docs/{file.src_uri} is not in the navigation of site/mkdocs.yml")
    for name, title in pages_of_their_own.items():
        if (built_pages / name).is_dir():
            nav.items.insert(1, Link(title, f"{name}/index.html"))
    return nav


def html_name(name):
    """README.md and index.md are a folder's index.html, as mkdocs names them."""
    if not name.endswith(".md"):
        return name
    folder, file = posixpath.split(name)
    stem = file[: -len(".md")]
    return posixpath.join(folder, ("index" if stem in ("README", "index") else stem) + ".html")


def target_on_site(page, link):
    """The address on the site of what `link` means in the file of `page`."""
    here = posixpath.dirname(html_name(page.file.src_uri)) or "."
    found = local_lab.match(link)
    if found:
        language = f"?lang={language_of(page)}" if language_of(page) != "en" else ""
        return posixpath.relpath("lab/index.html", here) + language + "#/lab" + link[found.end() :]
    if re.match(r"[a-zA-Z][\w+.-]*:|#|$", link):
        return link
    path, hash_sign, anchor = link.partition("#")
    path_of_page = elsewhere.get(page.file.src_uri, f"docs/{page.file.src_uri}")
    target = posixpath.normpath(posixpath.join(posixpath.dirname(path_of_page), unquote(path)))
    if target in name_of:
        name = html_name(name_of[target])
    elif target.startswith("docs/"):
        name = html_name(target[len("docs/") :])
    elif (root / target).is_file():
        sources.add(target)
        name = f"source/{target}.txt"
    else:
        name = f"missing/{target}"  # the check of the links names it
    return posixpath.relpath(name, here) + hash_sign + anchor


def language_of(page):
    folder = page.file.src_uri.split("/")[0]
    return folder if folder in ("it", "zh") else "en"


def anchor_of(heading, used):
    """As GitHub makes them: "What may be left out" -> "what-may-be-left-out"."""
    plain = "".join(c for c in heading.strip().lower() if c.isalnum() or c in " -_" or ord(c) >= 0x80 and c.isalpha())
    anchor = base = plain.replace(" ", "-")
    count = 0
    while anchor in used:
        count += 1
        anchor = f"{base}-{count}"
    used.add(anchor)
    return anchor


def coloured(code, language, _):
    try:
        lexer = get_lexer_by_name(language)
    except ClassNotFound:
        return ""
    return highlight(code, lexer, HtmlFormatter(nowrap=True))


def fence(self, tokens, index, options, env):
    words = tokens[index].info.split()
    language = words[0] if words else ""
    inner = coloured(tokens[index].content, language, "") or html.escape(tokens[index].content)
    return f'<div class="highlight"><pre><code tabindex="0">{inner}</code></pre></div>\n'


parser = MarkdownIt("commonmark").enable(["table", "strikethrough"])
parser.add_render_rule("fence", fence)
parser.add_render_rule("code_block", fence)


def without_gaps(children):
    """A line break between two Chinese characters is no blank."""
    def is_chinese(text, at):
        return text != "" and "\u2e80" <= text[at] <= "\uffef"

    return [
        token
        for i, token in enumerate(children)
        if not (token.type == "softbreak" and is_chinese(children[i - 1].content, -1) and is_chinese(children[i + 1].content, 0))
    ]


def plain_text(inline):
    return "".join(t.content for t in inline.children or [] if t.type in ("text", "code_inline"))


def on_page_markdown(markdown, page, config, files):
    tokens = parser.parse(markdown)
    used, entries = set(), []
    for i, token in enumerate(tokens):
        if token.type == "heading_open":
            heading = plain_text(tokens[i + 1])
            token.attrSet("id", anchor_of(heading, used))
            entries.append({"level": int(token.tag[1]), "id": token.attrGet("id"), "name": html.escape(heading), "children": []})
        if token.children:
            token.children = without_gaps(token.children)
        if token.type in ("th_open", "th_close") and not tokens[i + 1 if token.nesting == 1 else i - 1].content:
            token.tag = "td"  # an empty cell is no heading
        for child in token.children or []:
            for attribute in ("href", "src"):
                if child.attrGet(attribute) is not None:
                    child.attrSet(attribute, target_on_site(page, child.attrGet(attribute)))
            if child.type == "image":
                child.attrSet("loading", "lazy")
    page.rendered = parser.renderer.render(tokens, parser.options, {})
    page.entries = nested(entries)
    page.title = page.title.replace("`", "")
    return ""


def nested(entries):
    top, open_entries = [], []
    for entry in entries:
        while open_entries and open_entries[-1]["level"] >= entry["level"]:
            open_entries.pop()
        (open_entries[-1]["children"] if open_entries else top).append(entry)
        open_entries.append(entry)
    return top


def on_page_content(_, page, config, files):
    page.toc = get_toc(page.entries)
    return page.rendered


accessible = {  # what the theme lacks
    'role="dialog">': 'role="dialog" aria-label="Search">',
    'class="md-search__scrollwrap"': 'class="md-search__scrollwrap" tabindex="0"',
    '"search.config.pipeline": "trimmer, stopWordFilter"': '"search.config.pipeline": "stopWordFilter"',  # it drops Chinese
    '"select.version.title": "Select version"': '"select.version.title": ""',  # the button is named by its text
}


def on_post_page(output, page, config):
    for was, becomes in accessible.items():
        if was not in output:
            raise PluginError(f"hooks.py: the theme no longer has {was}")
        output = output.replace(was, becomes, 1)
    to_top = posixpath.relpath("site.js", posixpath.dirname(page.file.dest_uri) or ".")
    output = output.replace("</head>", f'<script src="{to_top}"></script></head>', 1)
    return output.replace('<html lang="en"', f'<html lang="{language_of(page)}"', 1)


mark_at_end = re.compile(r"([.,:;!?)\]}\"”’»…]+)(?=\s|$)")
mark_at_start = re.compile(r"(^|\s)([(\[{\"“‘«]+)")


def divide_words(index_file):
    """The search knows words between blanks. U+200B, which is not seen, divides Chinese words, and marks from words: "Z." has
    the word Z, and G38.2 stays whole.
    """
    jieba.setLogLevel("WARNING")
    jieba.dt.tmp_dir = str(built_pages)  # not one that others can write
    index = json.loads(index_file.read_text(encoding="utf-8"))
    # A decision is found by its title and its first words, so that the manual comes first.
    index["docs"] = [entry for entry in index["docs"] if not re.match(r"decisions/\d.*#", entry["location"])]
    for entry in index["docs"]:
        if entry["location"].startswith("decisions/0"):
            entry["text"] = entry["text"][:longest_summary]
        if entry["location"].startswith("zh/") and len(entry["title"]) <= longest_term:
            jieba.add_word(entry["title"])
    for entry in index["docs"]:
        for field in ("title", "text"):
            text = entry[field]
            if entry["location"].startswith("zh/"):
                text = "\u200b".join(jieba.cut(text))
            entry[field] = mark_at_start.sub("\\1\\2\u200b", mark_at_end.sub("\u200b\\1", text))
    index_file.write_text(json.dumps(index, ensure_ascii=False, separators=(",", ":")), encoding="utf-8")


@event_priority(-100)  # the plugin for the search has written its index
def on_post_build(config):
    divide_words(Path(config["site_dir"], "search/search_index.json"))
    for source in sorted(sources):
        copy = Path(config["site_dir"], "source", source + ".txt")
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_bytes((root / source).read_bytes())
