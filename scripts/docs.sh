#!/usr/bin/env bash
# Builds the site of the documents into build/site and fails on broken links: docs.sh [serve]. MkDocs Material comes from PyPI, below build/.
# README, CONTRIBUTING and CHANGELOG become pages too; links to sources stay links into the repository. Exit code 3: MkDocs could not be installed.
set -euo pipefail
cd "$(dirname "$0")/.."

tools=build/mkdocs
pages=build/pages
if [[ ! -x $tools/bin/mkdocs ]]; then
    python3 -m venv "$tools" || {
        echo "docs.sh: python3 -m venv failed; on Debian install python3-venv" >&2
        exit 3
    }
    "$tools/bin/pip" install --quiet mkdocs-material==9.8.2 || {
        rm -r "$tools"
        echo "docs.sh: MkDocs Material could not be installed from PyPI" >&2
        exit 3
    }
fi
python3 scripts/site.py "$pages"
export NO_MKDOCS_2_WARNING=1 # about another program
case ${1:-build} in
    build) "$tools/bin/mkdocs" build --strict --config-file "$pages/mkdocs.yml" --site-dir "$PWD/build/site" && echo "docs: $PWD/build/site/index.html" ;;
    serve) exec "$tools/bin/mkdocs" serve --config-file "$pages/mkdocs.yml" ;;
    *)
        echo "docs.sh: unknown argument '$1', expected nothing or 'serve'" >&2
        exit 2
        ;;
esac
