# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds what an x86-64 processor with SSE4.2 alone does not understand: ``instructions.py MODULE OBJECT...``.

MODULE is what was linked, and has no symbols; OBJECTs are what it was linked from. In those, AVX instructions may be in the functions of a
namespace ``avx2`` alone, which the library calls where the processor has them; the module may have no more than these. An object of LLVM's
bitcode has no instructions before it is linked: the module's count covers it.
"""

import re
import subprocess
import sys
from pathlib import Path

FUNCTION = re.compile(r"^[0-9a-f]+ <(.+)>:$")
# Every VEX and EVEX instruction begins with a v, or works on general registers (BMI, AVX-512's masks).
NEWER = re.compile(
    r"\t(?!verr|verw)(v[a-z]\w+|andn|bextr|bls[ir]|blsmsk|bzhi|mulx|pdep|pext|rorx|sarx|shlx|shrx|k[a-z]+[bwdq])[lq]?\s"
)
DISPATCHED = re.compile(r"4avx2\d")
BITCODE = b"BC\xc0\xde"


def count_newer(path: Path) -> dict[str, int]:
    """Return how many instructions above SSE4.2 each function has, by its mangled name."""
    found: dict[str, int] = {}
    function = ""
    # LLVM's reads what is built for Windows and macOS as well.
    command = ["llvm-objdump", "-d", "--no-show-raw-insn", str(path)]
    for line in subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines():
        if match := FUNCTION.match(line):
            function = match[1]
        elif NEWER.search(line + " "):
            found[function] = found.get(function, 0) + 1
    return found


def faults_of_instructions(module: Path, objects: list[Path]) -> list[str]:
    """Return a sentence for each function that has instructions above SSE4.2 and must not."""
    compiled = [path for path in objects if not path.read_bytes().startswith(BITCODE)]
    counts = [(path, function, count) for path in compiled for function, count in count_newer(path).items()]
    faults = [
        f"{path.name}: {function} has {count} instructions above SSE4.2"
        for path, function, count in counts
        if not DISPATCHED.search(function)
    ]
    known = sum(count for _, _, count in counts)
    there = sum(count_newer(module).values())
    if there > known:
        faults.append(f"{module.name}: {there - known} instructions above SSE4.2 come from none of its objects")
    return faults


if __name__ == "__main__":
    sys.exit("\n".join(faults_of_instructions(Path(sys.argv[1]), [Path(name) for name in sys.argv[2:]])) or 0)
