"""tidy_test.py PAGE.html...: what HTML Tidy, which knows HTML 5, finds wrong; nothing is right."""

import re
import shutil
import subprocess
import sys

from browser import skip

if not shutil.which("tidy"):
    skip("tidy is not installed")
# Tidy has no list of SVG's attributes.
PLACE_OF_SVG = re.compile(r'<svg> proprietary attribute "(x|y|width|height)"')
remarks = [remark
           for page in sys.argv[1:]
           for remark in subprocess.run(["tidy", "-e", "-q", page], capture_output=True, text=True,
                                        check=False).stderr.splitlines()
           if not PLACE_OF_SVG.search(remark)]
print(*remarks, sep="\n")
sys.exit(1 if remarks else 0)
