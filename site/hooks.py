"""Pages of the site from where they lie in the repository, as MkDocs is to see them."""

import re
from pathlib import Path

from mkdocs.structure.files import File

ROOT = Path(__file__).parent.parent
API = ROOT / "build/docs/api"
KATEX = Path("/usr/share/javascript/katex")
FOLDERS = ["docs", "bases", "solvers", "effects", "benchmarks", "data", "tests/mutants"]
LINK = re.compile(r"\]\(([^)#:\s]+)(#[^)]*)?\)")


def pages():
    """The Markdown files of the site: their paths there and in the repository.

    The first page of the repository is none of the name that MkDocs gives a folder's first page.
    """
    yield "readme.md", ROOT / "README.md"
    for name in ["CONTRIBUTING.md", "CHANGELOG.md", "python/README.md"]:
        yield name, ROOT / name
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*.md")):
            yield path.relative_to(ROOT).as_posix(), path


def linked(page):
    """Files and folders to which a page links, as paths in the repository."""
    prose = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    targets = (page.parent / found[1] for found in LINK.finditer(prose))
    return {target.resolve() for target in targets if target.exists()}


def listing(folder):
    """A page with the files of a folder: programs as they stand, links to others."""
    lines = [f"# {folder.relative_to(ROOT)}\n"]
    for path in sorted(folder.iterdir()):
        if path.suffix in (".cpp", ".hpp"):
            lines.append(f"## {path.name}\n\n```cpp\n{path.read_text()}```\n")
        elif path.is_file():
            lines.append(f"- [{path.name}]({path.name})")
    return "\n".join(lines)


def on_files(files, config):
    """Adds pages, what they link to, the interface and KaTeX."""
    def add(uri, path):
        if files.get_file_from_path(uri) is None:
            files.append(File.generated(config, uri, abs_src_path=str(path)))

    targets = set()
    for uri, path in pages():
        add(uri, path)
        targets |= linked(path)
    for target in sorted(targets):
        uri = target.relative_to(ROOT).as_posix()
        if target.is_dir():
            files.append(File.generated(config, f"{uri}/index.md", content=listing(target)))
            targets_of = [path for path in target.iterdir() if path.is_file()]
            for path in targets_of:
                add(f"{uri}/{path.name}", path)
        elif target.suffix != ".md":
            add(uri, target)
    for folder, name in [(API, "api"), (KATEX, "katex"), (KATEX / "fonts", "katex/fonts")]:
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                add(f"{name}/{path.relative_to(folder).as_posix()}", path)
    return files


def on_config(config):
    """Puts the pages of a folder below the page of the same name, in the order of its links."""
    def with_folder(entry):
        if isinstance(entry, dict):
            return {title: [with_folder(one) for one in below] if isinstance(below, list) else below
                    for title, below in entry.items()}
        page = ROOT / entry
        if not page.with_suffix("").is_dir() or page.suffix != ".md":
            return entry
        links = [found[1] for found in LINK.finditer(page.read_text())]
        below = [f"{page.parent.name}/{link}" for link in dict.fromkeys(links)
                 if link.startswith(f"{page.stem}/") and link.endswith(".md")]
        return {title_of(page): [entry, *below]}

    config.nav = [with_folder(entry) for entry in config.nav]
    return config


def title_of(page):
    """The first heading of a page."""
    return next(line[2:] for line in page.read_text().splitlines() if line.startswith("# "))


def on_page_markdown(markdown, page, **_):
    """Links to folders lead to their pages; a block that is a file has its name as a title."""
    here = ROOT / page.file.src_uri
    here = here if here.exists() else ROOT / "README.md"

    def to_page(found):
        target = here.parent / found[1]
        return f"]({found[1]}/index.md)" if target.is_dir() else found[0]

    named = re.sub(r"^```ode (\S+)", r'```text title="\1"', markdown, flags=re.M)
    return LINK.sub(to_page, named.replace("```ode\n", "```text\n"))
