#!/usr/bin/env bash
# Formats the tracked C++ sources in place, or those given.
#
# usage: tools/dev/format.sh [--check] [FILE...]
# --check changes nothing and fails where something would change
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/../.."
mode=(-i)
if [ "${1:-}" = --check ]; then
    mode=(--dry-run --Werror)
    shift
fi
if [ $# -gt 0 ]; then
    files=("$@")
else
    mapfile -t files < <(git ls-files '*.cpp' '*.hpp')
fi
clang-format "${mode[@]}" --style=file "${files[@]}"
