"""Property: manual pages and completions know every command and every option that --help knows.

  manual_test.py GHTRACK
"""
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path


def output(*command, **kwargs):
    return subprocess.run(command, check=True, capture_output=True, text=True, **kwargs).stdout


def long_options(text):
    """The options of a help text: what stands at the beginnings of its lines."""
    found = set()
    for line in text.splitlines():
        match = re.match(r"\s+(-[^ ].*)", line)
        if match:
            names = re.split(r"\s{2,}|\s[A-Z]+", match.group(1))[0]
            found.update(re.findall(r"--[a-z][a-z0-9-]*", names))
    return found


def commands(ghtrack):
    text = output(ghtrack, "--help")
    return re.findall(r"^  ([a-z]+) ", text.split("Subcommands:")[1].split("Examples")[0], re.M)


def completed(script, *words):
    """What bash offers after these words, the last of which is being typed."""
    program = 'source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _ghtrack; echo "${COMPREPLY[@]}"'
    return set(output("bash", "-c", program, "bash", str(script), "ghtrack", *words).split())


def main():
    ghtrack = sys.argv[1]
    names = commands(ghtrack)
    assert len(names) >= 10, names
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ghtrack, "manual", folder], check=True)
        bash = Path(folder) / "bash-completion/completions/ghtrack"
        zsh = Path(folder) / "zsh/site-functions/_ghtrack"
        pages = Path(folder) / "man/man1"
        assert completed(bash, "") >= set(names)
        for name in names:
            options = long_options(output(ghtrack, name, "--help"))
            assert options, name
            page = pages / f"ghtrack-{name}.1"
            text = page.read_text(encoding="utf-8").replace("\\-", "-")
            missing = {option for option in options if option not in text}
            assert not missing, f"{page.name} lacks {missing}"
            missing = options - completed(bash, name, "--")
            assert not missing, f"bash does not complete {missing} of {name}"
            assert f"ghtrack\\-{name}" in (pages / "ghtrack.1").read_text(encoding="utf-8")
        if shutil.which("groff"):
            for page in sorted(pages.iterdir()):
                complaints = subprocess.run(["groff", "-K", "utf8", "-man", "-ww", "-z", str(page)], check=True,
                                            capture_output=True, text=True).stderr
                assert not complaints, f"{page.name}: {complaints}"
        if shutil.which("zsh"):
            subprocess.run(["zsh", "-n", str(zsh)], check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
