"""Checks that everything a site links to and loads is there, anchors too.

Usage: check_links.py FOLDER [--online]   (--online: pages elsewhere are asked for too)
"""

import sys
import urllib.error
import urllib.request
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urldefrag


class Page(HTMLParser):
    """What a page has anchors for, links to and loads."""

    def __init__(self, path):
        super().__init__()
        self.anchors, self.links, self.loads = set(), [], []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        given = dict(attributes)
        self.anchors |= {given[key] for key in ("id", "name") if given.get(key)}
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        if tag in ("img", "script", "iframe") and given.get("src"):
            self.loads.append(given["src"])
        if tag == "link" and given.get("rel") in ("stylesheet", "icon"):
            self.loads.append(given["href"])


def is_elsewhere(link):
    return link.split(":")[0] in ("http", "https", "mailto", "data", "javascript")


def faults_of(path, page, pages, root):
    """A line for each link of a page that leads nowhere, and each thing loaded from elsewhere."""
    for link in page.links + page.loads:
        if is_elsewhere(link):
            if link in page.loads and link.startswith("http"):
                yield f"{path}: loads {link}"
            continue
        name, anchor = urldefrag(link)
        start = root if name.startswith("/") else path.parent
        target = (start / unquote(name).lstrip("/")).resolve() if name else path
        if target.is_dir():
            target = target / "index.html"
        if not target.exists():
            yield f"{path}: {link} is not there"
        elif anchor == "nested-classes" and "api" in path.parts:
            continue  # Doxygen 1.9 links to a list that it leaves out where all in it is private
        elif anchor and target in pages and unquote(anchor) not in pages[target].anchors:
            yield f"{path}: {link} has no such place"


def answers(link):
    """Whether a page elsewhere can be had, or refuses programs only."""
    request = urllib.request.Request(link, headers={"User-Agent": "Mozilla/5.0"})
    try:
        return urllib.request.urlopen(request, timeout=20).status < 400
    except urllib.error.HTTPError as error:
        return error.code in (401, 403, 405, 429)
    except OSError:
        return False


def main(folder, online):
    root = Path(folder).resolve()
    paths = sorted(root.rglob("*.html"))
    pages = {path: Page(path) for path in paths}
    faults = [fault for path, page in pages.items() for fault in faults_of(path, page, pages, root)]
    links = {link for page in pages.values() for link in page.links if link.startswith("http")}
    if online:
        faults += [f"{link} does not answer" for link in sorted(links) if not answers(link)]
    print("\n".join(faults))
    count = sum(len(page.links) + len(page.loads) for page in pages.values())
    print(f"{len(pages)} pages, {count} links, {len(links)} pages elsewhere, {len(faults)} faults")
    return 1 if faults or not pages else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--online" in sys.argv[2:]))
