# Completion of casimir's command line for bash. What fits is asked of the program itself.
# shellcheck shell=bash
_casimir() {
  local current=${COMP_WORDS[COMP_CWORD]} previous='' whole kept line word i
  local -a words=()
  # bash breaks words at = and :, which casimir does not.
  for ((i = 1; i <= COMP_CWORD; i++)); do
    word=${COMP_WORDS[i]}
    if [[ ${#words[@]} -gt 0 && ($word == [=:]* || $previous == *[=:]) ]]; then
      words[${#words[@]} - 1]+=$word
    else
      words+=("$word")
    fi
    previous=$word
  done
  whole=${words[${#words[@]} - 1]}
  [[ $current != [=:]* ]] || current=''
  kept=${whole%"$current"}
  COMPREPLY=()
  while IFS= read -r line; do
    if [[ $line == :files ]]; then
      compopt -o filenames
      while IFS= read -r word; do COMPREPLY+=("$word"); done < <(compgen -f -- "$current")
    else
      word=${line%%$'\t'*}
      [[ $word != *= ]] || compopt -o nospace
      word=${word#"$kept"}
      printf -v word %q "$word"
      COMPREPLY+=("$word")
    fi
  done < <("${1/#\~/$HOME}" complete "${words[@]}" 2>/dev/null)
}
complete -F _casimir casimir
