_vextract() {
    local i cur prev opts cmd
    COMPREPLY=()
    if [[ "${BASH_VERSINFO[0]}" -ge 4 ]]; then
        cur="$2"
    else
        cur="${COMP_WORDS[COMP_CWORD]}"
    fi
    prev="$3"
    cmd=""
    opts=""

    for i in "${COMP_WORDS[@]:0:COMP_CWORD}"
    do
        case "${cmd},${i}" in
            ",$1")
                cmd="vextract"
                ;;
            *)
                ;;
        esac
    done

    case "${cmd}" in
        vextract)
            opts="-o -j -q -v -h -V --files-from --scene --camera --illuminant --sky-illuminant --wavelengths-nm --panel0 --panel1 --panel --chart --white-region --regions --margin --refine --distortion --overlay --preview --transfer --black-level --white-level --white --undo --exposure --chart-reference --chart-grid --chart-cos --save-camera --white-reflectance --white-cos --output --resume --threads --quiet --verbose --progress --save --no-history --generate --list --help --version"
            if [[ ${cur} == -* || ${COMP_CWORD} -eq 1 ]] ; then
                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
                return 0
            fi
            case "${prev}" in
                --files-from)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --scene)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --camera)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --illuminant)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --sky-illuminant)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --wavelengths-nm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --panel0)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --panel1)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --panel)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --chart)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --white-region)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --regions)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --margin)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --refine)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --distortion)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --overlay)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --preview)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --transfer)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --black-level)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --white-level)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --white)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --undo)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --exposure)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --chart-reference)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --chart-grid)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --chart-cos)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --save-camera)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --white-reflectance)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --white-cos)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --output)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                -o)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --resume)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --threads)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                -j)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --progress)
                    COMPREPLY=($(compgen -W "auto always never" -- "${cur}"))
                    return 0
                    ;;
                --save)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --generate)
                    COMPREPLY=($(compgen -W "man stream schema bash zsh fish" -- "${cur}"))
                    return 0
                    ;;
                --list)
                    COMPREPLY=($(compgen -W "cameras illuminants reflectances" -- "${cur}"))
                    return 0
                    ;;
                *)
                    COMPREPLY=()
                    ;;
            esac
            COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
            return 0
            ;;
    esac
}

if [[ "${BASH_VERSINFO[0]}" -eq 4 && "${BASH_VERSINFO[1]}" -ge 4 || "${BASH_VERSINFO[0]}" -gt 4 ]]; then
    complete -F _vextract -o nosort -o bashdefault -o default vextract
else
    complete -F _vextract -o bashdefault -o default vextract
fi

