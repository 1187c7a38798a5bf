#!/bin/sh
# What the library promises its host program: it never prints, exits, aborts,
# longjmps, reads the environment or sets the locale of the process, and keeps
# no variable that changes.  All of this shows in its symbols.
set -eu
: "${top_builddir:=.}" "${NM:=nm}"
library=$top_builddir/lib/.libs/libkoksma.so
status=0

skip() {
    echo "$*"
    exit 77
}
[ -f "$library" ] || skip "There is no shared library to look into."
command -v "${NM%% *}" >/dev/null 2>&1 || skip "There is no $NM to look into the library with."

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# Name|Value|Class|Type|Size|Line|Section, without the blanks and versions.
$NM -f sysv "$library" | tr -d ' ' | sed 's/@[^|]*//' >"$scratch/symbols"

# Sanitizers and coverage bring calls and counters of their own.
! grep -Eq '^(__asan|__ubsan|__tsan|__gcov|__sanitizer|__llvm_prof)' "$scratch/symbols" ||
    skip "The library is instrumented, and has more names than its own."

forbidden='printf|vprintf|__printf_chk|__vprintf_chk|puts|putchar|perror|stdout|stderr|stdin'
forbidden="$forbidden|exit|_exit|_Exit|quick_exit|abort|raise|__assert_fail"
forbidden="$forbidden|longjmp|_longjmp|siglongjmp|getenv|secure_getenv|setlocale|rand|srand|strtok"

for name in $(awk -F '|' '$3 == "U" { print $1 }' "$scratch/symbols" | grep -Ex "$forbidden"); do
    echo "The library uses $name, which is its host program's business."
    status=1
done

# Constant tables that hold pointers are in .data.rel.ro.  Names with two
# underscores, completed.0 and the like come with the compiler.
for name in $(awk -F '|' '$7 ~ /^\.(data|bss|tdata|tbss)$/ && $1 !~ /^(__|_edata|_end|completed)/ \
    { print $1 }' "$scratch/symbols"); do
    echo "The library keeps a variable that can change, $name."
    status=1
done
exit $status
