#!/usr/bin/env bash
# The corpus is one archive; a folder of it for each target.
#   tests/fuzz/pack.sh add TARGET FILE..   adds inputs, each under the digest of its bytes
#   tests/fuzz/pack.sh unpack FOLDER       leaves FOLDER/corpus/TARGET/*
set -euo pipefail

archive=$(cd -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")" && pwd -P)/corpus.tar.gz

unpack() {
  mkdir -p "$1"
  tar -xzf "$archive" -C "$1"
}

# The same inputs make the same archive.
pack() {
  tar --sort=name --mtime=@0 --owner=0 --group=0 --numeric-owner --mode=u=rwX,go=rX -C "$1" -cf - corpus |
    gzip -n9 >"$archive.new"
  mv "$archive.new" "$archive"
}

case ${1-}:$# in
  unpack:2) unpack "$2" ;;
  add:[3-9] | add:[1-9][0-9]*)
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    unpack "$work"
    mkdir -p "$work/corpus/$2"
    for file in "${@:3}"; do
      cp -- "$file" "$work/corpus/$2/$(sha1sum <"$file" | cut -d' ' -f1)"
    done
    pack "$work"
    ;;
  *)
    sed -n '2,4s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
    ;;
esac
