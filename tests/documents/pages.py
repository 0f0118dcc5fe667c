"""Pages of Markdown: their text without code, their links, anchors and commands; and what is wrong with a tree of them.

Each check gives a list of "file:line: what is wrong", empty where all is well.
"""

import re
import shlex
from pathlib import Path

LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\[\]]*\])*\]\(\s*<?([^()\s<>]+(?:\([^()]*\))?)>?(?:\s+\"[^\"]*\")?\s*\)")
DEFINITION = re.compile(r"^\s{0,3}\[[^\]]+\]:\s+<?(\S+?)>?\s*$")
HEADING = re.compile(r"^#{1,6}\s+(.*?)\s*#*$")
ANCHOR = re.compile(r"<a\s+(?:id|name)=\"([^\"]+)\"")
FENCE = re.compile(r"^\s*(```+|~~~+)\s*(\S*)")
LIST_ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s")
CODE_SPAN = re.compile(r"(`+)(.+?)\1")
COMMAND_LANGUAGES = {"", "sh", "bash", "shell", "console"}


class Page:
    """A page, taken apart: `prose` and `code` are lists of (line number, text), `fenced` of (language, first line number, text)."""

    def __init__(self, path):
        self.path = Path(path)
        self.lines = self.path.read_text(encoding="utf-8").splitlines()
        self.prose, self.code, self.fenced = [], [], []
        self._take_apart()

    def _take_apart(self):
        fence, last_flush, blank, indented = None, "", True, False
        for number, line in enumerate(self.lines, 1):
            mark = FENCE.match(line)
            if fence:
                if mark and mark[1].startswith(fence) and not mark[2]:
                    fence = None
                else:
                    self.fenced[-1][2].append(line)
                    if self.fenced[-1][0] in COMMAND_LANGUAGES:
                        self.code.append((number, line))
                continue
            if mark:
                fence = mark[1]
                self.fenced.append((mark[2], number, []))
                continue
            inside_list = LIST_ITEM.match(last_flush) is not None
            indented = line.startswith("    ") and not inside_list and (blank or indented)
            if indented:
                self.code.append((number, line.strip()))
            else:
                self.prose.append((number, line))
            blank = not line.strip()
            if line.strip() and not line.startswith(" "):
                last_flush = line

    def links(self):
        """(line number, target) of every link and picture."""
        found = []
        for number, line in self.prose:
            text = CODE_SPAN.sub(lambda span: " " * len(span[0]), line)
            found += [(number, target) for target in LINK.findall(text) + DEFINITION.findall(text)]
        return found

    def anchors(self):
        """Names of the places in the page, as GitHub makes them of headings."""
        found, counts = set(), {}
        for _, line in self.prose:
            found.update(ANCHOR.findall(line))
            heading = HEADING.match(line)
            if heading:
                name = slug(heading[1])
                count = counts[name] = counts.get(name, -1) + 1
                found.add(f"{name}-{count}" if count else name)
        return found

    def commands(self):
        """(line number, words) of each command that begins with scarp or make, in code blocks and in code spans of the prose."""
        lines = list(self.code)
        for number, line in self.prose:
            lines += [(number, span[1]) for span in CODE_SPAN.findall(line)]
        found = []
        for number, line in lines:
            for part in re.split(r"&&|\|\||;", line.split("  #")[0]):
                words = words_of(part)
                if len(words) > 1 and words[0] in ("scarp", "make"):
                    found.append((number, words))
        return found


def slug(heading):
    text = re.sub(r"\[([^\[\]]*)\]\([^)]*\)", r"\1", heading).lower()
    return "".join("-" if letter == " " else letter for letter in text if letter.isalnum() or letter in " -_")


def words_of(line):
    """The words of a command, without brackets of what is optional, up to a comment or two spaces (a remark beside it)."""
    line = re.split(r"(?<=\S) {2,}", re.sub(r"^\s*\$\s", "", line).strip())[0]
    try:
        words = shlex.split(line, comments=True)
    except ValueError:
        return []
    return [word for word in (re.sub(r"^\[|\]?(?:\.\.\.)?[.,]?$", "", word) for word in words) if word]


def pages_of(root):
    """The pages that are checked, in order."""
    root = Path(root)
    paths = [root / "README.md", root / "CONTRIBUTING.md", root / "CHANGELOG.md"]
    paths += sorted(root.glob("docs/**/*.md")) + sorted(root.glob("examples/**/*.md"))
    return {path: Page(path) for path in paths if path.exists()}


def broken_links(root, pages):
    root, found = Path(root).resolve(), []
    anchors = {}
    for path, page in pages.items():
        for number, target in page.links():
            if re.match(r"[a-z][a-z+.-]*:", target):
                continue  # another place in the world
            name, _, place = target.partition("#")
            where = f"{path}:{number}: ({target})"
            other = (path.parent / name).resolve() if name else path.resolve()
            if root not in (other, *other.parents):
                found.append(f"{where} leaves the project")
            elif not other.exists():
                found.append(f"{where} is not there")
            elif place and other.suffix != ".md":
                found.append(f"{where} names a place in what is no page")
            elif place:
                if other not in anchors:
                    anchors[other] = Page(other).anchors()
                if place not in anchors[other]:
                    found.append(f"{where}: no heading of that name")
    return found


def unlisted_pages(root, pages):
    """Pages of docs/ to which docs/README.md has no link."""
    index = Path(root) / "docs" / "README.md"
    if index not in pages:
        return [f"{index}:1: the index of the pages is not there"]
    linked = {(index.parent / target.partition("#")[0]).resolve() for _, target in pages[index].links()}
    docs = [path for path in pages if index.parent in path.parents and path != index]
    return [f"{path}:1: docs/README.md has no link to it" for path in docs if path.resolve() not in linked]


def too_long(path, limit):
    count = len(Path(path).read_text(encoding="utf-8").splitlines())
    return [f"{path}:{count}: {count} lines, more than {limit}"] if count > limit else []


def targets_of(makefile):
    return set(re.findall(r"^([a-z][\w-]*)\s*:(?!=)", Path(makefile).read_text(encoding="utf-8"), flags=re.MULTILINE))


class Program:
    """What the program says of itself: `help_of(subcommand or "")` gives the text of its --help."""

    def __init__(self, help_of):
        self.help_of = help_of
        text = help_of("")
        self.subcommands = set(re.findall(r"^  ([a-z]\w*) ", text.partition("Subcommands:")[2], flags=re.MULTILINE))
        self.options = {"": self._options(text)}

    @staticmethod
    def _options(text):
        return set(re.findall(r"(?<![\w-])--?[a-z][\w-]*", text))

    def options_of(self, subcommand):
        if subcommand not in self.options:
            self.options[subcommand] = self._options(self.help_of(subcommand))
        return self.options[subcommand]


def is_placeholder(word):
    """CASE.toml, TEST.toml, DIR: for the reader to replace."""
    return re.fullmatch(r"[A-Z][A-Z_]*(\.\w+)?", word) is not None


def wrong_command(words, targets, program, file_exists):
    """What is wrong with one command, or nothing."""
    if words[0] == "make":
        missing = [word for word in words[1:] if "=" not in word and not word.startswith("-") and word not in targets]
        return f"the Makefile has no target {missing[0]}" if missing else None
    subcommand = "" if words[1].startswith("-") else words[1]
    if subcommand and subcommand not in program.subcommands:
        return f"scarp has no command {subcommand}"
    rest = words[2:] if subcommand else words[1:]
    for word in rest:
        option = word.partition("=")[0]
        if option.startswith("-") and not re.match(r"-\d", option) and option not in program.options_of(subcommand):
            return f"{' '.join(['scarp', subcommand]).strip()} has no option {option}"
    if subcommand in ("run", "check", "lab"):
        files = [word for word in rest if word.endswith(".toml") and "=" not in word and not is_placeholder(word)]
        missing = [name for name in files if not file_exists(name)]
        return f"there is no file {missing[0]}" if missing else None
    return None


def wrong_commands(page, targets, program, file_exists):
    found = []
    for number, words in page.commands():
        wrong = wrong_command(words, targets, program, file_exists)
        if wrong:
            found.append(f"{page.path}:{number}: `{' '.join(words)}`: {wrong}")
    return found


def version_of(header):
    return re.search(r"version = \"([\d.]+)\"", Path(header).read_text(encoding="utf-8"))[1]


def other_versions(version, citation, changelog):
    """Where the citation or the list of changes speaks of another version than the program."""
    found = []
    cited = re.search(r"^version: *\"?([\w.]+)\"?$", Path(citation).read_text(encoding="utf-8"), flags=re.MULTILINE)
    if not cited or cited[1] != version:
        found.append(f"{citation}:1: version {cited[1] if cited else 'missing'}, the program is {version}")
    text = Path(changelog).read_text(encoding="utf-8")
    coming = re.search(r"^## \[Unreleased\]\n+[^#]*?\b(?:becomes|become) (\d+\.\d+\.\d+)", text, flags=re.MULTILINE)
    last = re.search(r"^## \[(\d+\.\d+\.\d+)\] - \d{4}-\d\d-\d\d$", text, flags=re.MULTILINE)
    here = coming or last
    if not here or here[1] != version:
        found.append(f"{changelog}:1: version {here[1] if here else 'missing'}, the program is {version}")
    return found
