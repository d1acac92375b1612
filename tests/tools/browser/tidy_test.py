"""tidy_test.py PAGE.html...: what HTML Tidy, which knows HTML 5, finds wrong; nothing is right."""

import shutil
import subprocess
import sys

from browser import skip

if not shutil.which("tidy"):
    skip("tidy is not installed")
remarks = [remark
           for page in sys.argv[1:]
           for remark in subprocess.run(["tidy", "-e", "-q", page], capture_output=True, text=True,
                                        check=False).stderr.splitlines()]
print(*remarks, sep="\n")
sys.exit(1 if remarks else 0)
