# Completion of casimir's command line for fish. What fits is asked of the program itself.
function __casimir_complete
    set -l words (commandline -opc)
    set -l current (commandline -ct)
    for line in ($words[1] complete $words[2..-1] "$current" 2>/dev/null)
        if test "$line" = :files
            # Of --option=FILE only what is behind the sign is a file.
            set -l option (string match -r -- '^--[^=]*=' "$current"; or echo '')
            set -l path (string sub -s (math (string length -- "$option") + 1) -- "$current")
            printf '%s\n' $option(__fish_complete_path "$path")
        else
            echo -- $line
        end
    end
end
complete -c casimir -f -a '(__casimir_complete)'
