"""Compares the sources that pages of the manual show with the files that they come from.

A block that follows a line <!-- from: FILE --> must stand in FILE, word by word.
"""

import pathlib
import re
import sys

SOURCE = pathlib.Path(__file__).resolve().parent.parent
BLOCK = re.compile(r"<!-- from: (\S+) -->\n```\w*\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def main():
    num_blocks, failures = 0, []
    for page in sorted((SOURCE / "docs").rglob("*.md")):
        text = page.read_text()
        name = page.relative_to(SOURCE)
        if text.count("<!-- from:") != len(BLOCK.findall(text)):
            failures.append(f"{name}: a line <!-- from: ... --> is not followed by a block")
        for place, block in BLOCK.findall(text):
            num_blocks += 1
            if block not in (SOURCE / place).read_text():
                failures.append(f"{name}: this does not stand in {place}:\n{block}")
    print("\n".join(failures))
    print(f"{num_blocks} blocks compared")
    if num_blocks == 0:
        sys.exit("nothing was compared")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
