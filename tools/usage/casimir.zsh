#compdef casimir
# Completion of casimir's command line for zsh. What fits is asked of the program itself.

_casimir() {
  local line word note
  local -a plain open
  for line in "${(@f)$("${(Q)words[1]/#\~/$HOME}" complete "${(@Q)words[2,CURRENT]}" 2>/dev/null)}"; do
    if [[ $line == :files ]]; then
      # The value in --option=value.
      [[ $PREFIX != --*=* ]] || compset -P '*='
      _files
      continue
    fi
    [[ -n $line ]] || continue
    word=${line%%$'\t'*}
    note=${line#*$'\t'}
    [[ $note != $line ]] || note=''
    word=${word//:/\\:}${note:+:$note}
    if [[ ${line%%$'\t'*} == *= ]]; then open+=("$word"); else plain+=("$word"); fi
  done
  (( ! $#plain )) || _describe casimir plain
  (( ! $#open )) || _describe casimir open -S ''
}

if [[ $funcstack[1] == _casimir ]]; then _casimir "$@"; else compdef _casimir casimir; fi
