#!/usr/bin/env python3
"""Wraps the prose of Markdown pages at 110 columns. Tables, code, headings and single words that are
longer stay as they are. Only paragraphs that hold a line that is too long are touched.

    scripts/wrap_docs.py [--check] FILE...

With --check nothing is written: names what is too long, and fails if there is any.
"""
import re
import sys

WIDTH = 110
# What begins a block of its own, behind any spaces.
ITEM = re.compile(r"(?:[-*+]|\d+\.|:) +")
NO_PROSE = re.compile(r"\||#|<|!\[|\[[^\]]+\]: |---|===")
# What must not begin a line, or the line would begin a block.
TAKEN = re.compile(r"(?:[-*+>=|#:]|\d+[.)]$|---)")


def fill(words, first, rest):
    """Lines of the words, the first behind `first`, the others behind `rest`."""
    lines, line, begin = [], [], first
    for word in words:
        if line and len(begin) + len(" ".join(line)) + 1 + len(word) > WIDTH:
            over = [word]
            while TAKEN.match(over[0]) and len(line) > 1:
                over.insert(0, line.pop())
            lines.append(begin + " ".join(line))
            line, begin = over, rest
        else:
            line.append(word)
    return lines + [begin + " ".join(line)]


def blocks(text):
    """The page's lines in blocks: (is it prose, its lines)."""
    fenced, block, base = False, [], 0
    for line in text.split("\n"):
        bare = line.lstrip(" ")
        indent = len(line) - len(bare)
        if bare.startswith("```"):
            if block:
                yield True, block
                block = []
            fenced = not fenced
            yield False, [line]
        elif fenced or not bare or NO_PROSE.match(bare) or (not block and indent >= base + 4):
            if block:
                yield True, block
                block = []
            if bare and indent == 0:
                base = 0
            yield False, [line]
        elif ITEM.match(bare):
            if block:
                yield True, block
            base = indent + len(ITEM.match(bare).group())
            block = [line]
        else:
            if not block and indent == 0:
                base = 0
            block.append(line)
            # Two spaces at the end are a break.
            if line.endswith("  "):
                yield True, block
                block = []
    if block:
        yield True, block


def is_long(line):
    return len(line) > WIDTH and " " in line.strip()


def wrap(text):
    lines = []
    for is_prose, block in blocks(text):
        if not is_prose or not any(is_long(line) for line in block):
            lines += block
            continue
        indent = re.match(" *", block[0]).group()
        item = ITEM.match(block[0][len(indent):])
        first = indent + (item.group() if item else "")
        rest = re.match(" *", block[1]).group() if len(block) > 1 else " " * len(first)
        words = " ".join([block[0][len(first):]] + block[1:]).split()
        wrapped = fill(words, first, rest)
        if block[-1].endswith("  "):
            wrapped[-1] += "  "
        lines += wrapped
    return "\n".join(lines)


def main():
    arguments = sys.argv[1:]
    check = "--check" in arguments
    failed = False
    for name in arguments:
        if name == "--check":
            continue
        with open(name, encoding="utf-8") as file:
            text = file.read()
        wrapped = wrap(text)
        if wrapped == text:
            continue
        if not check:
            with open(name, "w", encoding="utf-8") as file:
                file.write(wrapped)
            continue
        failed = True
        old = text.split("\n")
        number = next(i for i, line in enumerate(wrapped.split("\n")) if line != old[i])
        print(f"{name}:{number + 1}: the paragraph has lines of more than {WIDTH} characters",
              file=sys.stderr)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
