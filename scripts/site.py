#!/usr/bin/env python3
"""Prepares the folder that MkDocs makes the site of: site.py FOLDER. Called by scripts/docs.sh.

The site's root is the repository's: README.md, CONTRIBUTING.md, CHANGELOG.md and docs/, so that links between them hold as they stand. A link to
another file of the repository (a source, a script) is checked here: it must exist, and becomes plain text on the site. The menu is that of
docs/README.md."""

import os
import re
import shutil
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TOP = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md"]

CONFIG = """site_name: quasilux
docs_dir: {folder}/root
use_directory_urls: false
theme:
  name: material
  font: false
  features: [navigation.sections, content.code.copy]
plugins: [search]
markdown_extensions:
  - tables
  - toc: {{permalink: true, slugify: !!python/object/apply:pymdownx.slugs.slugify {{kwds: {{case: lower}}}}}}
  - pymdownx.superfences
  - pymdownx.highlight
validation:
  links: {{anchors: warn, unrecognized_links: warn}}
nav:
{menu}
"""


def on_site(target):
    """Is this path, relative to the root, a file of the site?"""
    return target in TOP or target.startswith("docs/")


def links_as_on_site(text, page):
    """`text` of `page`, a path from the root: links to files that the site lacks lose their target."""

    def checked(match):
        words, file = match.group(1), match.group(2)
        target = os.path.normpath(os.path.join(os.path.dirname(page), file))
        if not (ROOT / target).exists():
            sys.exit(f"{page}: the link to {file} leads nowhere")
        return match.group(0) if on_site(target) else words

    return re.sub(r"(?<!!)\[([^\]]*)\]\(([^)#:]+)(?:#[^)]*)?\)", checked, text)


def menu():
    """Sections and pages of docs/README.md, as MkDocs wants them."""
    lines = ["  - Start: README.md", "  - Documents: docs/README.md"]
    for line in (ROOT / "docs" / "README.md").read_text().splitlines():
        if section := re.match(r"\*\*([^*]+)\*\*", line):
            lines.append(f'  - "{section.group(1)}":')
        elif line.startswith(("- ", "  [")):
            lines += [f'      - "{words}": docs/{file}' for words, file in re.findall(r"\[([^\]]+)\]\(([^)#]+\.md)\)", line)]
    return "\n".join([*lines, "  - Contributing: CONTRIBUTING.md", "  - Changes: CHANGELOG.md"])


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: site.py FOLDER")
    folder = Path(sys.argv[1]).resolve()
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder / "root" / "docs")
    for page in [*TOP, *(str(path.relative_to(ROOT)) for path in (ROOT / "docs").rglob("*.md"))]:
        (folder / "root" / page).write_text(links_as_on_site((ROOT / page).read_text(), page))
    (folder / "mkdocs.yml").write_text(CONFIG.format(folder=folder, menu=menu()))


if __name__ == "__main__":
    main()
