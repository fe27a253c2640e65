# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender as a Python module (``bpy``) behind Blender's own command line, as far as tests in the background need it.

Understands ``--background``, ``--factory-startup`` (always so), ``--python-exit-code``, ``--python``, ``--python-expr``, ``--version``, the
name of a .blend file, and ``--``, in the order given, as Blender does. Anything else is refused rather than ignored.
"""

import runpy
import sys
import traceback

import bpy


def main(arguments: list[str]) -> int:
    """Do what the arguments say, in their order; return the exit code."""
    exit_code_of_failure = 0
    sys.argv = ["blender", *arguments]
    waiting = iter(arguments)
    for argument in waiting:
        if argument == "--":
            break
        if argument in {"-b", "--background", "--factory-startup"}:
            continue
        if argument in {"-v", "--version"}:
            print(f"Blender {bpy.app.version_string}")
            return 0
        if argument == "--python-exit-code":
            exit_code_of_failure = int(next(waiting))
        elif argument in {"-P", "--python", "--python-expr"}:
            code = next(waiting)
            try:
                if argument == "--python-expr":
                    exec(compile(code, "<--python-expr>", "exec"), {"__name__": "__main__"})
                else:
                    runpy.run_path(code, run_name="__main__")
            except Exception:
                traceback.print_exc()
                if exit_code_of_failure:
                    return exit_code_of_failure
        elif argument.endswith(".blend"):
            bpy.ops.wm.open_mainfile(filepath=argument)
        else:
            print(f"bpy_blender.py does not know the argument {argument}", file=sys.stderr)
            return 2
    return 0


sys.exit(main(sys.argv[1:]))
