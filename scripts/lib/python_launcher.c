// SPDX-License-Identifier: GPL-3.0-or-later
// python.exe for the Windows Python of scripts/lib/windows_python.py, which comes as a DLL alone. It uses neither the C library nor its
// headers, which zig would have to compile first: a minute's work or more.
typedef unsigned short character;

__declspec(dllimport) character* GetCommandLineW(void);
__declspec(dllimport) character** CommandLineToArgvW(const character* line, int* count);
__declspec(dllimport) void ExitProcess(unsigned code);
__declspec(dllimport) int Py_Main(int count, character** arguments);

void start(void) {
  int count = 0;
  character** arguments = CommandLineToArgvW(GetCommandLineW(), &count);
  ExitProcess((unsigned)Py_Main(count, arguments));
}
