"""Runs every command line that README.md and the manual show.

Commands stand in blocks fenced as ```sh (each line is one) or ```console (lines that start with "$ "). A block is one
shell session. The blocks of a page run one after another in a copy of the repository made of links, in which
build/release is the given build folder; what they write stays in the copy. A command that another test runs is listed in docs/commands_elsewhere.txt, by its exact
text, with that place: it is not run here, and a line of the list that no page shows any more is an error.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
LIST = SOURCE / "docs" / "commands_elsewhere.txt"


def pages():
    return [SOURCE / "README.md", *sorted((SOURCE / "docs").rglob("*.md"))]


def sessions(page):
    """The blocks of a page, each a list of (line number, command); a trailing backslash continues a command."""
    kind, found, pending = None, [], None
    for number, line in enumerate(page.read_text().splitlines(), 1):
        if kind is None:
            fence = re.match(r"^\s*```(sh|console)\s*$", line)
            if fence:
                kind = fence.group(1)
                found.append([])
            continue
        if line.strip() == "```":
            if pending:
                sys.exit(f"{page}:{number}: the block ends within a command")
            kind = None
            continue
        text = line.strip()
        if pending:
            number, text = pending[0], pending[1] + " " + text
            pending = None
        elif kind == "console":
            if not text.startswith("$ "):
                continue
            text = text[2:]
        elif not text or text.startswith("#"):
            continue
        if text.endswith("\\"):
            pending = (number, text[:-1].rstrip())
        else:
            found[-1].append((number, text))
    if kind is not None:
        sys.exit(f"{page}: a block of commands is not closed")
    return [session for session in found if session]


def commands_elsewhere():
    """Command -> where it runs. Each line: command => file: text that stands in the file."""
    listed = {}
    for number, line in enumerate(LIST.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        match = re.fullmatch(r"(.+?) => ([^:]+): (.+)", line)
        if not match:
            sys.exit(f"{LIST}:{number}: expected 'command => file: text in it', found '{line}'")
        command, place, text = match.groups()
        if not (SOURCE / place).is_file() or text not in (SOURCE / place).read_text():
            sys.exit(f"{LIST}:{number}: '{place}' is not a file that has the text '{text}'")
        listed[command] = place
    return listed


def scratch_copy(folder, build):
    for entry in SOURCE.iterdir():
        if not entry.name.startswith("build") and entry.name not in (".git", "demo-results"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(build)


def run(session, name, folder, timeout):
    script = "set -euo pipefail\n"
    for number, command in session:
        script += f"printf '\\n%s\\n' {sh_quoted(f'{name}:{number}: {command}')}\n{command}\n"
    try:
        result = subprocess.run(["bash", "-c", script], cwd=folder, stdin=subprocess.DEVNULL, timeout=timeout)
    except subprocess.TimeoutExpired:
        print(f"FAILED: the commands of {name} from line {session[0][0]} ran for more than {timeout} s")
        return False
    if result.returncode:
        print(f"FAILED: the commands of {name} from line {session[0][0]}: exit status {result.returncode}")
    return result.returncode == 0


def sh_quoted(text):
    return "'" + text.replace("'", "'\\''") + "'"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", required=True, type=pathlib.Path, help="build folder, with bin/ and lib/")
    parser.add_argument("--page", action="append", help="this page only, such as docs/theory/impm.md; repeat for several")
    parser.add_argument("--timeout", type=float, default=600, help="seconds for one block")
    args = parser.parse_args()
    elsewhere = commands_elsewhere()
    unseen = set(elsewhere)
    passed, failed, skipped = 0, 0, 0
    os.environ["PATH"] = "/usr/bin:" + os.environ["PATH"]  # the python3 for which Debian packages matplotlib
    for page in pages():
        name = str(page.relative_to(SOURCE))
        if args.page and name not in args.page:
            continue
        with tempfile.TemporaryDirectory(prefix="honeyguide-docs-") as folder:
            scratch_copy(pathlib.Path(folder), args.build.resolve())
            for session in sessions(page):
                here = []
                for number, command in session:
                    if command in elsewhere:
                        unseen.discard(command)
                        skipped += 1
                        print(f"{name}:{number}: {command}\n  runs in {elsewhere[command]}")
                    else:
                        here.append((number, command))
                if not here:
                    continue
                sys.stdout.flush()
                if run(here, name, folder, args.timeout):
                    passed += len(here)
                else:
                    failed += len(here)
    if args.page:
        unseen = set()  # the other pages may show them
    for command in sorted(unseen):
        print(f"FAILED: {LIST.relative_to(SOURCE)} lists '{command}', which no page shows")
    print(f"\n{passed} commands ran, {skipped} run elsewhere, {failed} in blocks that failed, {len(unseen)} listed in vain")
    if passed + skipped == 0:
        sys.exit("no page shows a command: nothing was checked")
    sys.exit(1 if failed or unseen else 0)


if __name__ == "__main__":
    main()
