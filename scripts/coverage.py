#!/usr/bin/python3
"""Coverage of the host's sources and of the kernels; called by scripts/coverage.sh.

    coverage.py instrument FOLDER       copies kernels/ to FOLDER with a counter at the start of every function and block, and writes counters.json
                                        and an empty file of counters, kernels.hits, beside it
    coverage.py report FOLDER HOST      tables by folder: of HOST, what gcovr found (JSON), and of the kernels' counters; functions that were not reached

A counter is a byte at an address that kernels and processes agree on (tests/shims/kernel_counters.cpp), so this is for OpenCL devices that run in the
program's own memory, as CPUs do. What a macro defines over several lines, and blocks without braces, have no counters."""
import json
import re
import shutil
import sys
from collections import defaultdict
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ADDRESS = 0x100000000000
SIZE = 1 << 16
BLOCK = re.compile(r"^\s+.*(\)|\belse|\bdo) \{$")


def counter_at(number):
    return f" ((volatile __global uchar*){ADDRESS:#x}ul)[{number}] = 1;"


def counted(line):
    """Whether a block begins at its end whose first statement may be a counter."""
    return line.endswith("{") and not re.search(r"\bswitch \(|= \{$", line)


def name_of(text):
    """Of a function, by what stands before its braces."""
    return re.search(r"(\w+)\(", re.sub(r"__attribute__\(\(.*?\)\)\)?", "", text)).group(1)


def is_pragma(line):
    """One that has to stand first in its block, as FP_CONTRACT."""
    return line.startswith("#pragma")


ONE_LINE = re.compile(r"^(\w.*?\b(\w+)\(.*?\) \{)( .*\}.*)$")


def instrument_file(path, source, counters):
    """Lines stay where they are. A function's head may be several lines, from the first that begins in column 0."""
    lines, head, inside, waiting = [], "", None, ""
    source = source.split("\n")
    for number, line in enumerate(source, 1):
        if waiting and not is_pragma(line):
            line, waiting = waiting + line, ""
        if line[:1].isalpha() or line[:2] == "__":
            head = ""
        head += line.strip() + " "
        is_function = line.endswith(") {") and "(" in head and not line.startswith(("    if", "    for", "    while")) and inside is None \
            and not head.startswith(("typedef", "struct", "#"))
        if is_function:
            inside = name_of(head)
        if inside and counted(line) and (is_function or BLOCK.match(line) or line.strip() == "{"):
            counters.append({"file": path, "line": number, "function": inside, "isFunction": is_function})
            if is_pragma(source[number]):
                waiting = counter_at(len(counters) - 1)
            else:
                line += counter_at(len(counters) - 1)
        elif inside is None and (one := ONE_LINE.match(line)) and not line.startswith(("typedef", "struct")):
            counters.append({"file": path, "line": number, "function": name_of(line), "isFunction": True})
            line = one[1] + counter_at(len(counters) - 1) + one[3]
        if line == "}":
            inside, head = None, ""
        lines.append(line)
    return "\n".join(lines)


def instrument(folder):
    kernels, counters = ROOT / "kernels", []
    shutil.rmtree(folder, ignore_errors=True)
    for source in sorted(kernels.rglob("*")):
        if source.suffix not in (".h", ".clh", ".cl"):
            continue
        path = source.relative_to(kernels)
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        text = source.read_text()
        (folder / path).write_text(text if source.suffix == ".h" else instrument_file(str(path), text, counters))
    assert len(counters) < SIZE
    (folder.parent / "counters.json").write_text(json.dumps(counters))
    (folder.parent / "kernels.hits").write_bytes(bytes(SIZE))
    print(f"coverage: {len(counters)} counters in kernels, {sum(c['isFunction'] for c in counters)} of them of functions")


def share(part, whole):
    return f"{100 * part / whole:.1f} %" if whole else "-"


def print_table(title, columns, sums):
    """Rows by folder, each of pairs reached and all; with their sum."""
    print(f"\n| {title} | " + " | ".join(columns) + " |\n|---|" + "---|" * len(columns))
    total = [tuple(map(sum, zip(*pairs))) for pairs in zip(*sums.values())]
    for name, pairs in [*sorted(sums.items()), ("all", total)]:
        print(f"| {name} | " + " | ".join(f"{part} of {whole}, {share(part, whole)}" for part, whole in pairs) + " |")


def report_host(file):
    sums, missed = defaultdict(lambda: [(0, 0)] * 3), set()
    reached = defaultdict(int)
    for source in json.loads(file.read_text())["files"]:
        name = source["file"]
        folder = "/".join(name.split("/")[:2])
        lines = [line for line in source["lines"] if not line.get("gcovr/noncode")]
        branches = [branch for line in lines for branch in line["branches"]]
        for function in source["functions"]:
            key = (name, function["lineno"])
            reached[key] = max(reached[key], function["execution_count"])
            missed.add((*key, function["name"]))
        counts = [(sum(bool(line["count"]) for line in lines), len(lines)), (sum(bool(b["count"]) for b in branches), len(branches)), (0, 0)]
        sums[folder] = [(a + c, b + d) for (a, b), (c, d) in zip(sums[folder], counts)]
    for (name, _), count in reached.items():
        folder = "/".join(name.split("/")[:2])
        hit, every = sums[folder][2]
        sums[folder][2] = (hit + bool(count), every + 1)
    print_table("host", ["lines", "branches", "functions"], sums)
    print("\nFunctions of the host that no test reaches:\n")
    for name, line, function in sorted(missed):
        if not reached[(name, line)]:
            print(f"- `{name}:{line}` {function}")


def report_kernels(folder):
    counters, hits = json.loads((folder / "counters.json").read_text()), (folder / "kernels.hits").read_bytes()
    sums, missed = defaultdict(lambda: [(0, 0)] * 2), []
    for number, counter in enumerate(counters):
        path = Path("kernels") / counter["file"]
        functions, blocks = sums[str(path.parent)]
        hit = int(hits[number] != 0)
        if counter["isFunction"]:
            functions = (functions[0] + hit, functions[1] + 1)
        sums[str(path.parent)] = [functions, (blocks[0] + hit, blocks[1] + 1)]
        if not hit and (counter["isFunction"] or hits_of_function(counters, hits, counter)):
            missed.append((str(path), counter))
    print_table("kernels", ["functions", "blocks"], sums)
    for what, of_functions in (("Functions", True), ("Blocks, within functions that tests reach,", False)):
        print(f"\n{what} of the kernels that no test reaches:\n")
        for path, counter in missed:
            if counter["isFunction"] == of_functions:
                print(f"- `{path}:{counter['line']}` {counter['function']}")


def hits_of_function(counters, hits, block):
    """Whether the function that the block is in was reached."""
    return any(hits[k] for k, c in enumerate(counters) if c["isFunction"] and c["file"] == block["file"] and c["function"] == block["function"]
               and c["line"] <= block["line"])


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "instrument":
        instrument(Path(sys.argv[2]))
    elif len(sys.argv) == 4 and sys.argv[1] == "report":
        report_host(Path(sys.argv[3]))
        report_kernels(Path(sys.argv[2]))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
