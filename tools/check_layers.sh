#!/usr/bin/env bash
# Checks who includes whom, that no code names a case and no library an option of the program, and that a
# constant of a source has a name which no other source of its layer uses: sources are compiled many at a time,
# in groups that change with each new file. Prints FILE:LINE: offence for each.
#
#   tools/check_layers.sh [ROOT]       checks the tree at ROOT (by default this one)
#   tools/check_layers.sh --self-test  bends a small tree in each way and expects to be told
set -euo pipefail

# Reads "FILE:LINE:TEXT" of every include and prints the forbidden ones.
# shellcheck disable=SC2016
readonly include_rules='
function layer(file) {
  if (file ~ /^runtime\/kernels\//) return "runtime/kernels"
  if (file ~ /^tools\/analysis\//) return "tools/analysis"
  return substr(file, 1, index(file, "/") - 1)
}
BEGIN {
  may["symbolic"] = "^symbolic/"
  may["codegen"] = "^(codegen/|symbolic/|runtime/program[.]hpp$|runtime/program/(exact_number|function_table)[.]hpp$|runtime/module_abi[.]h$|runtime/instruction_set[.]hpp$|runtime/taylor/quadratic_form[.]hpp$|runtime/taylor/lane_form[.]hpp$)"
  may["runtime"] = "^runtime/"
  may["runtime/kernels"] = "^(runtime/kernels/|runtime/module_abi[.]h$)"
  may["tools/analysis"] = "^(tools/analysis|codegen|symbolic|runtime)/"
  may["tools"] = "^(tools|codegen|symbolic|runtime)/"
  # Libraries that would carry one layer'"'"'s business into another.
  never["symbolic"] = "^(Eigen/|CLI/|nlohmann/|sundials/|boost/)"
  never["codegen"] = "^(Eigen/|CLI/|toml|sundials/)"
  never["runtime"] = "^(ginac/|toml|CLI/|nlohmann/|iostream$)"
  never["tools/analysis"] = "^(CLI/|toml|mpi|sundials/|iostream$)"
  never["runtime/kernels"] = "^(ginac/|cln/|toml|CLI/|nlohmann/|iostream$)"
}
match($0, /^[^:]+:[0-9]+:/) {
  place = substr($0, 1, RLENGTH - 1)
  text = substr($0, RLENGTH + 1)
  file = place
  sub(/:[0-9]+$/, "", file)
  name = layer(file)
  if (match(text, /"[^"]*"/)) {
    target = substr(text, RSTART + 1, RLENGTH - 2)
    if (target !~ may[name]) print place ": " name " must not include \"" target "\""
  } else if (match(text, /<[^>]*>/)) {
    target = substr(text, RSTART + 1, RLENGTH - 2)
    if (name in never && target ~ never[name]) print place ": " name " must not include <" target ">"
  }
}'

# Reads "FILE:LINE:TEXT" of every constexpr in a source, prints those outside of all functions whose name is
# in another source of the layer too. Of "int kA = 1, kB = 2" both names count. What computes in long numbers
# is compiled apart from the rest of runtime/, and each kernel by itself.
# shellcheck disable=SC2016
readonly constant_rules='
function layer(file) {
  if (file ~ /^tools\/analysis\//) return "tools/analysis"
  if (file ~ /^tests\/runtime\//) return "tests/runtime"
  if (file ~ /^runtime\/(certificate|digits|exact)\//) return "runtime/digits"
  if (file ~ /^runtime\/kernels\//) return file
  return substr(file, 1, index(file, "/") - 1)
}
match($0, /^[^:]+:[0-9]+:/) {
  place = substr($0, 1, RLENGTH - 1)
  text = substr($0, RLENGTH + 1)
  file = place
  sub(/:[0-9]+$/, "", file)
  outer = text !~ /^ /
  while (match(text, /[^A-Za-z0-9_]k[A-Z][A-Za-z0-9]*(\[\])?( = |\{)/)) {
    name = substr(text, RSTART + 1, RLENGTH - 1)
    text = substr(text, RSTART + RLENGTH)
    gsub(/[^A-Za-z0-9]/, "", name)
    key = layer(file) " " name
    if (!((key, file) in seen)) users[key] = users[key] file "\n"
    seen[key, file] = 1
    if (outer) { ++outers; outer_place[outers] = place; outer_file[outers] = file; outer_key[outers] = key }
  }
}
END {
  for (i = 1; i <= outers; ++i) {
    count = split(users[outer_key[i]], others, "\n") - 1
    for (j = 1; j <= count; ++j)
      if (others[j] != outer_file[i]) {
        split(outer_key[i], words, " ")
        print outer_place[i] ": the constant " words[2] " is in " others[j] " too"
        break
      }
  }
}'

# Applies rules to what is read. Rules that awk cannot apply are an offence and not a clean tree.
offences_by() {
  awk "$1" || printf 'tools/check_layers.sh: the rules could not be applied\n'
}

# The sources below the given folders of the tree; folders that are not there have none.
sources() {
  local folder
  for folder in "$@"; do
    [[ ! -d $folder ]] || find "$folder" -type f \( -name '*.[ch]pp' -o -name '*.h' \)
  done | LC_ALL=C sort
}

forbidden_includes() {
  sources symbolic codegen runtime tools |
    xargs -r -d '\n' grep -HnE '^[[:space:]]*#[[:space:]]*include' |
    offences_by "$include_rules"
}

# A string literal that is the name of a case, or a path to one. A method may have the name of the map
# that it is.
named_cases() {
  local names
  names=$(find cases -name '*.toml' 2>/dev/null | sed 's:.*/::; s:[.]toml$::' | LC_ALL=C sort |
    paste -sd'|')
  [[ -n $names ]] || return 0
  sources symbolic codegen runtime tools |
    xargs -r -d '\n' grep -HnE "^([^/]|/[^/])*\"([^\"]*/)?($names)([.]toml)?\"" |
    grep -vE '^runtime/methods[.]cpp:[0-9]+:[[:space:]]*[{][.]name = "[^"]*",$' |
    sed -E 's/^([^:]+:[0-9]+):[[:space:]]*(.*)$/\1: names a case: \2/'
}

# The libraries' users have no command line.
named_options() {
  sources symbolic codegen runtime tools/analysis |
    xargs -r -d '\n' grep -HnE '^([^/]|/[^/])*"([^"]*[[:space:](])?--[a-z][^"]*"' |
    sed -E 's/^([^:]+:[0-9]+):[[:space:]]*(.*)$/\1: names an option: \2/'
}

shared_constants() {
  sources symbolic codegen runtime tools tests/runtime |
    grep '[.]cpp$' |
    xargs -r -d '\n' grep -HnE '^[[:space:]]*(static |inline )?constexpr ' |
    offences_by "$constant_rules"
}

check() {
  local offences
  cd "$1"
  offences=$(forbidden_includes; named_cases; named_options; shared_constants) || true
  [[ -n $offences ]] || return 0
  printf '%s\n' "$offences"
  return 1
}

# expect TREE FILE TEXT MESSAGE [BEFORE]: TEXT as the only line of FILE must be reported, and as MESSAGE, after
# the line BEFORE.
expect() {
  local tree=$1 file=$2 text=$3 message=$4 before=${5-} output status=0
  mkdir -p "$tree/$(dirname "$file")"
  printf '%s\n' "$text" >"$tree/$file"
  output=$(check "$tree") || status=$?
  rm "$tree/$file"
  if [[ -n $message ]]; then message="$file:1: $message"; fi
  if [[ -n $before ]]; then message=$before${message:+$'\n'$message}; fi
  if [[ $output != "$message" || $status -ne $((${#message} > 0)) ]]; then
    printf 'self-test: %s in %s\n  expected: %s\n  reported: %s (status %d)\n' \
      "$text" "$file" "${message:-nothing}" "${output:-nothing}" "$status"
    return 1
  fi
}

self_test() {
  local tree failed=0
  tree=$(mktemp -d)
  # shellcheck disable=SC2064
  trap "rm -rf '$tree'" EXIT
  mkdir "$tree/cases"
  : >"$tree/cases/top.toml"

  bent() { expect "$tree" "$@" || failed=1; }
  bent symbolic/a.hpp '#include "codegen/x.hpp"' 'symbolic must not include "codegen/x.hpp"'
  bent symbolic/a.cpp '#include "runtime/program.hpp"' \
    'symbolic must not include "runtime/program.hpp"'
  bent symbolic/a.cpp '#include "b.hpp"' 'symbolic must not include "b.hpp"'
  bent symbolic/a.cpp '  #  include <Eigen/Dense>' 'symbolic must not include <Eigen/Dense>'
  bent codegen/a.cpp '#include "runtime/module.hpp"' \
    'codegen must not include "runtime/module.hpp"'
  bent codegen/a.cpp '#include "tools/report.hpp"' 'codegen must not include "tools/report.hpp"'
  bent runtime/a.cpp '#include "symbolic/x.hpp"' 'runtime must not include "symbolic/x.hpp"'
  bent runtime/a.h '#include "codegen/x.hpp"' 'runtime must not include "codegen/x.hpp"'
  bent runtime/a.cpp '#include <ginac/ginac.h>' 'runtime must not include <ginac/ginac.h>'
  bent runtime/kernels/a.hpp '#include "runtime/program.hpp"' \
    'runtime/kernels must not include "runtime/program.hpp"'
  bent tools/analysis/a.cpp '#include "tools/cli/output.hpp"' \
    'tools/analysis must not include "tools/cli/output.hpp"'
  bent tools/analysis/sweep/a.hpp '#include <CLI/CLI.hpp>' \
    'tools/analysis must not include <CLI/CLI.hpp>'
  bent tools/commands/a.cpp '#include "tests/systems.hpp"' \
    'tools must not include "tests/systems.hpp"'
  bent tools/a.cpp 'if (name == "top") {' 'names a case: if (name == "top") {'
  bent runtime/methods.cpp 'f(); {.name = "top",' 'names a case: f(); {.name = "top",'
  bent codegen/a.cpp 'read("cases/top.toml");' 'names a case: read("cases/top.toml");'

  bent symbolic/a.cpp 'throw ModelError("give one with --param");' \
    'names an option: throw ModelError("give one with --param");'
  bent tools/analysis/a.cpp '{"--integral", 1, 1}' 'names an option: {"--integral", 1, 1}'

  bent symbolic/a.cpp '#include "symbolic/b.hpp"' ''
  bent codegen/a.cpp 'run("-Wl,--build-id=none");' ''
  bent tools/a.cpp 'say("give one with --param");' ''
  bent symbolic/a.cpp '// as with --param' ''
  bent codegen/a.cpp '#include "runtime/program.hpp"' ''
  bent runtime/kernels/a.hpp '#include "runtime/module_abi.h"' ''
  bent runtime/a.cpp '#include <vector>' ''
  bent tools/commands/a.cpp '#include "runtime/module.hpp"' ''
  bent tools/commands/a.cpp '#include "tools/analysis/a.hpp"' ''
  bent tools/analysis/a.cpp '#include "codegen/compile.hpp"' ''
  bent tools/a.cpp 'help("for instance: casimir show top");' ''
  bent tools/a.cpp '// such as "top"' ''

  printf 'constexpr int kFew = 1;\n' >"$tree/tools/few.cpp"
  bent tools/many.cpp 'constexpr int kMany = 9, kFew = 2;' \
    'the constant kFew is in tools/few.cpp too' "tools/few.cpp:1: the constant kFew is in tools/many.cpp too"
  bent tools/many.cpp '  constexpr double kFew[] = {2};' \
    '' "tools/few.cpp:1: the constant kFew is in tools/many.cpp too"
  bent tools/many.cpp 'constexpr int kFewer = 2;' ''
  bent tools/analysis/few.cpp 'constexpr int kFew = 2;' ''

  if [[ $failed -eq 0 ]]; then printf 'self-test passed\n'; fi
  return "$failed"
}

if [[ ${1-} == --self-test ]]; then
  self_test
else
  check "${1:-$(dirname -- "${BASH_SOURCE[0]}")/..}"
fi
