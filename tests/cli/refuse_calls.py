#!/usr/bin/env python3
"""Runs a command to which the kernel refuses some system calls: refuse_calls.py CALL ERRNO COMMAND...

CALL is one of those below, of which only writers of files make use: "create" is an open that makes a
file, and "write" one at a place in it (pwrite), as talk and pipes are not written. A filter of the kernel (seccomp) answers in the call's stead, as a full disk or a file server
would. Exits with 77 where filters are not permitted or the machine's calls are not known here.
"""
import ctypes
import errno
import os
import platform
import struct
import sys

# Numbers of the calls, and the machine's own in <linux/audit.h>.
MACHINES = {
    "x86_64": (0xC000003E, {
        "create": [2, 257], "write": [18], "flush": [74, 75], "rename": [82, 264, 316],
        "reserve": [285], "map": [26], "folder": [83, 258], "lock": [73]}),
    "aarch64": (0xC00000B7, {
        "create": [56], "write": [68], "flush": [82, 83], "rename": [38, 276],
        "reserve": [47], "map": [227], "folder": [34], "lock": [32]}),
}
OPEN_BY_PATH = 2  # x86-64's open(), whose flags are its second argument; openat's are the third
LOAD, JUMP_IF_EQUAL, JUMP_IF_ANY, RETURN = 0x20, 0x15, 0x45, 0x06
ALLOW, REFUSE = 0x7FFF0000, 0x00050000
NUMBER_AT, MACHINE_AT, ARGUMENTS_AT = 0, 4, 16
PR_SET_NO_NEW_PRIVS, PR_SET_SECCOMP, SECCOMP_MODE_FILTER = 38, 22, 2


def filter_of(machine, call, numbers, error):
    """The instructions: (code, jump if true, jump if false, value)."""
    program = [(LOAD, 0, 0, MACHINE_AT), (JUMP_IF_EQUAL, 1, 0, machine), (RETURN, 0, 0, ALLOW)]
    for number in numbers:
        if call == "create":
            flags = ARGUMENTS_AT + 8 * (1 if number == OPEN_BY_PATH else 2)
            test = [(LOAD, 0, 0, flags), (JUMP_IF_ANY, 0, 1, os.O_CREAT)]
        else:
            test = [(LOAD, 0, 0, NUMBER_AT), (JUMP_IF_EQUAL, 0, 1, number)]
        program += [(LOAD, 0, 0, NUMBER_AT), (JUMP_IF_EQUAL, 0, 3, number), *test,
                    (RETURN, 0, 0, REFUSE | error)]
    return program + [(RETURN, 0, 0, ALLOW)]


def install(program):
    code = ctypes.create_string_buffer(b"".join(struct.pack("HBBI", *line) for line in program))
    header = ctypes.create_string_buffer(struct.pack("HxxxxxxP", len(program), ctypes.addressof(code)))
    libc = ctypes.CDLL(None, use_errno=True)
    return (libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 and
            libc.prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, header, 0, 0) == 0)


def main(call, error, *command):
    if platform.machine() not in MACHINES:
        return 77
    machine, calls = MACHINES[platform.machine()]
    if not install(filter_of(machine, call, calls[call], getattr(errno, error))):
        return 77
    os.execv(command[0], command)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
