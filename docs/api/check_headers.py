"""Checks that the public headers say what a caller must know, from the text of the headers and of interface/src alone.

A function has a text of its own, in the lines that begin with /// just before it. To it belong the text of its group
(the block with @defgroup) and those of its file and of ceed.h (the blocks with @file), which say once what holds for
many. Demanded:

parameters  Each is named in the function's own text, or in an item "- `name`: ..." of the other texts. Two need none
            where the file's text has the rule: the first argument, if it is the object that the function is of ("first
            argument"), and the last one of a function that makes or asks ("last argument").
shapes      A function with arrays of numbers says how many they hold, in its own text or in the item of the array, or
            names the function whose arguments it has; one with a size or an offset in bytes says bytes.
ownership   A function that hands out handles, strings or arrays says in its own text who ends their life, or an item
            "- `pattern`: ..." of the other texts does, whose pattern fits the function's name (handles) or is the type.
errors      Each CEED_ERROR_ code that the implementation may raise is explained in one of the texts; a code in the
            function's own text is one that the implementation may raise.

Pages show each group, and each program of examples/, once.

What the implementation may raise is found by walking from the function through all that it calls, by names. That finds
too much rather than too little, but sees no errors of backends, which the file's text is about.
"""

import argparse
import collections
import fnmatch
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = HERE.parent.parent
HEADERS = ["ceed.h", "backend.h", "plugin.h", "jit-tools.h", "cuda.h", "hip.h"]
HANDLES = ["Ceed", "CeedVector", "CeedElemRestriction", "CeedBasis", "CeedQFunction", "CeedQFunctionContext",
           "CeedOperator", "CeedObject", "CeedRequest"]
OWNERSHIP = re.compile(r"\b(frees?|free\(\)|points into|belongs?|keeps?|(not )?counted|caller destroys|valid|lives?"
                       r"|gives it back)\b")
NUMBERS = ["CeedScalar", "CeedInt", "CeedInt8", "bool", "double", "int32_t"]
SHAPE = re.compile(r"\bby\b|\bentr(y|ies)\b|\[|\beach\b|as many|coordinates|weights|`num_\w+`|Q_1d|length|of them|\*n\b"
                   r"|Ceed\w+\(\)")
CODE = re.compile(r"CEED_ERROR_(?:MINOR|DIMENSION|INCOMPLETE|INCOMPATIBLE|ACCESS|MAJOR|BACKEND|UNSUPPORTED)")
OPAQUE = ["Ref", "guard", "report"]  # what is raised there goes no further, or is the same for all

Function = collections.namedtuple("Function", "name result params own group file place")


def comment(line):
    """The text of a /// line, or None."""
    match = re.match(r"\s*///(?!<) ?(.*)", line)
    return match.group(1) if match else None


def functions_of(header):
    """Declarations with CEED_EXTERN and parentheses, with the texts that belong to them."""
    lines = header.read_text().splitlines()
    block, group, file_text, found = [], "", "", []
    i = 0
    while i < len(lines):
        line, text = lines[i], comment(lines[i])
        i += 1
        if text is not None:
            if text.strip() == "@{":
                group, block = "\n".join(block), []
            elif text.strip() == "@}":
                group, block = "", []
            else:
                block.append(text)
            continue
        if block and block[0].startswith("@file"):
            file_text = "\n".join(block)
        if line.startswith("CEED_EXTERN"):
            number = i
            while ";" not in line:
                line += " " + lines[i].strip()
                i += 1
            match = re.fullmatch(r"CEED_EXTERN (.*?[ *])(\w+)\((.*)\);", line)
            if match:
                result, name, arguments = match.groups()
                found.append(Function(name, result.strip(), parameters(arguments), "\n".join(block), group, file_text,
                                      f"{header.name}:{number}"))
        block = []
    return found


def parameters(arguments):
    """(type, name) of each; the name of a pointer to a function stands in its parentheses."""
    if arguments.strip() == "void":
        return []
    parts, depth, current = [], 0, ""
    for character in arguments:
        depth += {"(": 1, ")": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append(current)
            current = ""
        else:
            current += character
    result = []
    for part in [*parts, current]:
        part = part.strip()
        pointer = re.search(r"\(\*(\w+)\)", part)
        if part == "...":
            continue
        match = re.fullmatch(r"(.*?[ *])(\w+)(\[\d*\])?", part)
        if not pointer and not match:
            continue  # it has no name: the function's own text says what it is
        if pointer:
            result.append(("function", pointer.group(1)))
        else:
            result.append((match.group(1).strip() + (" *" if match.group(3) else ""), match.group(2)))
    return result


def items(text):
    """Names and patterns in items "- `a`, `b`: ...", with what the item says."""
    listed = {}
    for item in re.split(r"^\s*- ", text, flags=re.MULTILINE)[1:]:
        match = re.match(r"((?:`[^`]+`(?:, | and )?)+)[^:]*:(.*?)(?:\n\s*\n|\Z)", item, flags=re.DOTALL)
        if match:
            for name in re.findall(r"`([^`]+)`", match.group(1)):
                listed[name] = match.group(2)
    return listed


def is_named(name, text):
    return re.search(rf"(?<!\w){re.escape(name)}(?!\w)", text) is not None


def undocumented_parameters(function):
    shared = {**items(function.file), **items(function.group)}
    for position, (kind, name) in enumerate(function.params):
        if is_named(name, function.own) or name in shared:
            continue
        base = kind.replace("const", "").replace("*", "").strip()
        if position == 0 and base in HANDLES + ["CeedContextFieldLabel", "CeedQFunctionField", "CeedOperatorField"]:
            if "first argument" in function.file:
                continue
        asks = re.search(r"(Get|Is|Has)[A-Z]|Create", function.name) is not None
        if asks and position == len(function.params) - 1 and ("*" in kind) and "last argument" in function.file:
            continue
        yield name


def shapeless(function):
    """Arrays of numbers of which nothing is said, and sizes without their unit."""
    if "Restore" in function.name:
        return
    shared = {**items(function.file), **items(function.group)}
    for kind, name in function.params:
        text = function.own + shared.get(name, "")
        base, stars = kind.replace("const", "").replace("*", "").strip(), kind.count("*")
        is_array = stars >= 2 or (stars == 1 and (kind.startswith("const") or base == "CeedScalar"))
        if base in NUMBERS and is_array and not SHAPE.search(text) and not is_answer(function, name):
            yield f"does not say how many entries '{name}' has"
        if base == "size_t" and re.search("size|offset", name) and "bytes" not in text.lower():
            yield f"does not say that '{name}' counts bytes"


def is_answer(function, name):
    """Whether the argument is where one number goes, not an array."""
    return name in ("norm", "usage_mb")


def handed_out(function):
    """Types of the handles, strings and arrays that come out."""
    if re.search(r"Destroy$|Restore|Set[A-Z]", function.name):
        return  # those go in
    for kind, _ in function.params:
        base = kind.replace("const", "").replace("*", "").strip()
        stars = kind.count("*")
        if (base in HANDLES and base != "CeedRequest" and stars == 1 and not kind.startswith("const")) or (
                base not in HANDLES and stars >= 2):
            yield kind
    if function.result in HANDLES or function.result.endswith("*"):
        yield function.result


def says_who_owns(function, kind):
    """Whether the text says so, or a rule does: for handles by the name of the function, for others by the type."""
    if OWNERSHIP.search(function.own):
        return True
    name = function.name if kind.replace("*", "").strip() in HANDLES else kind
    rules = {**items(function.file), **items(function.group)}
    return any(OWNERSHIP.search(said) for pattern, said in rules.items()
               if pattern == name or ("*" in pattern and " " not in pattern and fnmatch.fnmatchcase(name, pattern)))


class Implementation:
    """Definitions in interface/src by their names, and the codes that each may raise."""

    def __init__(self, folder):
        self.bodies = {}  # (name, file) -> text
        self.classes = set()
        for path in sorted([*folder.rglob("*.cpp"), *folder.rglob("*.hpp")]):
            for name, body, is_class in definitions(path.read_text()):
                key = (name, path.stem)
                if is_class and not name.endswith("_private"):
                    self.classes.add(name)
                self.bodies[key] = self.bodies.get(key, "") + body
        self.files = collections.defaultdict(list)  # name -> files
        for name, file in self.bodies:
            self.files[name].append(file)

    def __contains__(self, name):
        return name in self.files

    def called(self, key):
        """What a definition calls, by name: of its own file, or of the only file that has the name."""
        text = self.bodies[key]
        calls = set(re.findall(r"(?<![.\w>])([A-Za-z_]\w*)(?:<[^<>]*>)?\(", text))
        for name in calls | (self.classes & set(re.findall(r"\w+", text))):
            files = self.files.get(name, [])
            if key[1] in files:
                yield name, key[1]
            elif len(files) == 1:
                yield name, files[0]

    def reached(self, name):
        """The definition of that name and all that it leads to."""
        waiting = [(name, file) for file in self.files.get(name, [])]
        seen = set(waiting)
        while waiting:
            for key in self.called(waiting.pop()):
                if key not in seen:
                    seen.add(key)
                    waiting.append(key)
        return seen

    def raised(self, name):
        return {code for key in self.reached(name) for code in CODE.findall(self.bodies[key])}

    def explain(self, name):
        for key in sorted(self.reached(name)):
            if CODE.search(self.bodies[key]):
                print(f"{key[0]} ({key[1]}):", *sorted(set(CODE.findall(self.bodies[key]))))


def definitions(text):
    """Functions and classes, with their bodies: they begin in the first column and end with a brace there."""
    head, body = "", None
    text = re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', text)  # messages name functions, too
    for line in re.sub(r"//[^\n]*", "", text).splitlines():
        if body is not None:
            if line.startswith("}"):
                name = defined_name(head)
                if name and name not in OPAQUE:
                    yield name, body, "(" not in head
                head, body = "", None
            else:
                body += line + "\n"
        elif not line.strip() or line.startswith(("#", "namespace", "}", "template", "extern")):
            head = ""
        else:
            head += " " + line
            if line.endswith("{"):
                body = ""
            elif line.endswith("}"):
                whole = re.match(r"([^{]*)\{(.*)\}$", head)
                if whole and defined_name(whole.group(1)):
                    yield defined_name(whole.group(1)), whole.group(2), False
                head = ""
            elif line.endswith(";"):
                head = ""


def defined_name(head):
    """The name that stands before the parenthesis, or that of a class."""
    match = re.search(r"(\w+)\(", re.sub(r"\[\[.*?\]\]", "", head)) or re.search(r"(?:class|struct) (\w+)", head)
    return match.group(1) if match else None


def not_shown(include):
    """Groups of functions and programs that no page of the reference shows, or that two do."""
    pages = "".join(page.read_text() for page in sorted(HERE.glob("*.md")))
    for header in HEADERS:
        for group in re.findall(r"^/// @defgroup (\w+)", (include / header).read_text(), flags=re.MULTILINE):
            count = len(re.findall(rf"^```\{{doxygengroup\}} {group}$", pages, flags=re.MULTILINE))
            if count != 1:
                yield f"{header}: the group {group} is on {count} pages of docs/api; expected 1"
    for program in sorted(HERE.glob("examples/*")):
        count = pages.count(f"{{literalinclude}} examples/{program.name}\n")
        if count != 1:
            yield f"docs/api/examples/{program.name} is on {count} pages; expected 1"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--include", type=pathlib.Path, default=SOURCE / "interface" / "include" / "ceed")
    parser.add_argument("--source", type=pathlib.Path, default=SOURCE / "interface" / "src")
    parser.add_argument("--show", metavar="FUNCTION", help="print what it calls that raises codes")
    args = parser.parse_args()
    implementation = Implementation(args.source)
    functions = [function for header in HEADERS for function in functions_of(args.include / header)]
    common = functions[0].file
    functions = [function._replace(file=common + "\n\n" + function.file) for function in functions]
    complaints = list(not_shown(args.include))
    for function in functions:
        def complain(text):
            complaints.append(f"{function.place}: {function.name}: {text}")

        codes = implementation.raised(function.name)
        if args.show == function.name:
            implementation.explain(function.name)
        if function.name not in implementation and function.name != "ceed_plugin_v1":
            complain(f"no definition found in {args.source}")
        if not function.own.strip():
            complain("has no text")
            continue
        for name in undocumented_parameters(function):
            complain(f"says nothing of the parameter '{name}'")
        for text in shapeless(function):
            complain(text)
        for kind in handed_out(function):
            if not says_who_owns(function, kind):
                complain(f"hands out a '{kind}' and does not say who owns it")
        explained = set(CODE.findall(function.own + function.group + function.file))
        for code in sorted(codes - explained):
            complain(f"may fail with {code}, which neither it nor its group nor its file explains")
        for code in sorted(set(CODE.findall(function.own)) - codes):
            complain(f"names {code}, which its implementation does not raise")
    print("\n".join(complaints))
    print(f"{len(functions)} functions, {len(complaints)} complaints")
    if len(functions) < 300:
        sys.exit("expected 300 functions or more: the headers were not understood")
    sys.exit(1 if complaints else 0)


if __name__ == "__main__":
    main()
