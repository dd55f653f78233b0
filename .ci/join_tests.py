"""Joins the tests of several build folders into one that ctest can run, so that one summary covers them all.

The joined folder lists the quick tests first, then the mechanics, then the long ones. A label that is required but has
no test is an error: a run that tests nothing must not pass.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys


def tests_of(build_dir):
    """The tests of a build folder, as ctest describes them."""
    text = subprocess.run(["ctest", "--test-dir", build_dir, "--show-only=json-v1"], check=True, capture_output=True,
                          text=True).stdout
    tests = []
    for test in json.loads(text[text.index("{"):])["tests"]:
        properties = {entry["name"]: entry["value"] for entry in test.get("properties", [])}
        # ctest leaves the command out where the program does not exist; run so, it is reported as not found.
        tests.append({"name": test["name"], "command": test.get("command", [test["name"] + "-was-not-built"]),
                      "properties": properties, "labels": properties.get("LABELS", [])})
    return tests


def rank(test):
    return 2 if "long" in test["labels"] else 1 if "mechanics" in test["labels"] else 0


def quoted(text):
    """A CMake bracket argument that holds any text."""
    level = 0
    while "]" + "=" * level + "]" in text or text.endswith("]" + "=" * level):
        level += 1
    return "[" + "=" * level + "[" + text + "]" + "=" * level + "]"


def written(test, prefix, cost):
    """The lines that register a test in a CTestTestfile.cmake."""
    name = quoted(prefix + test["name"])
    lines = [f"add_test({name} " + " ".join(quoted(word) for word in test["command"]) + ")"]
    properties = dict(test["properties"], COST=cost)
    for key, value in sorted(properties.items()):
        values = value if isinstance(value, list) else [value]
        if key == "DEPENDS" or key.startswith("FIXTURES_"):
            values = [prefix + one for one in values]
        if all(isinstance(one, (str, int, float)) for one in values):
            lines.append(f"set_tests_properties({name} PROPERTIES {key} {quoted(';'.join(str(one) for one in values))})")
        else:
            sys.exit(f"join_tests.py: test '{test['name']}' has a property {key} of an unknown form: {value}")
    return "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--into", required=True, help="folder to write CTestTestfile.cmake into")
    parser.add_argument("--require", nargs="*", default=[], help="labels that must have tests in the first folder")
    parser.add_argument("--second", help="a second build folder")
    parser.add_argument("--prefix", default="", help="what the names of the second folder's tests start with")
    parser.add_argument("--labels", nargs="*", default=[], help="the labels taken from the second folder")
    parser.add_argument("--without", default="", help="label not taken from the second folder")
    parser.add_argument("first", help="a build folder")
    args = parser.parse_args()

    def require(tests, labels, folder):
        for label in labels:
            if not any(label in test["labels"] for test in tests):
                sys.exit(f"join_tests.py: {folder} has no test with the label '{label}'")

    joined = [("", test) for test in tests_of(args.first)]
    require([test for _, test in joined], args.require, args.first)
    if args.second:
        taken = [test for test in tests_of(args.second)
                 if set(test["labels"]) & set(args.labels) and args.without not in test["labels"]]
        require(taken, args.labels, args.second)
        joined += [(args.prefix, test) for test in taken]
    joined.sort(key=lambda entry: (rank(entry[1]), entry[0]))

    into = pathlib.Path(args.into)
    into.mkdir(parents=True, exist_ok=True)
    # Times of an earlier run would overrule the order.
    (into / "Testing" / "Temporary" / "CTestCostData.txt").unlink(missing_ok=True)
    text = "\n".join(written(test, prefix, len(joined) - index) for index, (prefix, test) in enumerate(joined))
    (into / "CTestTestfile.cmake").write_text(text + "\n")


if __name__ == "__main__":
    main()
