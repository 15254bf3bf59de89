#!/usr/bin/env bash
# Formats every C++ file of this tree; with --check only says which ones would change.
set -euo pipefail
cd "$(dirname -- "${BASH_SOURCE[0]}")/.."

clang_format=${CLANG_FORMAT:-clang-format}
if ! command -v "$clang_format" >/dev/null; then
  printf 'clang-format is missing: apt-get install -y --no-install-recommends clang-format\n' >&2
  exit 4
fi

case ${1-} in
  '') mode=(-i) ;;
  --check) mode=(--dry-run --Werror) ;;
  *)
    printf 'usage: tools/format.sh [--check]\n' >&2
    exit 2
    ;;
esac

# What casimir emitted keeps its own layout.
find symbolic codegen runtime tools tests -type f \( -name '*.[ch]pp' -o -name '*.h' \) \
  -not -path 'tests/emitted/*' -print0 | LC_ALL=C sort -z |
  xargs -0 -r "$clang_format" --style=file "${mode[@]}"
