_vforward() {
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
                cmd="vforward"
                ;;
            *)
                ;;
        esac
    done

    case "${cmd}" in
        vforward)
            opts="-o -j -q -v -h -V --reflectance --panel-reflectance --facet-reflectance --camera --illuminant --sky-illuminant --wavelengths-nm --reference-panel --bounces --exposure --noise-sd --photon-noise --seed --gloss --gloss-roughness --body-roughness-deg --fuzz --render --render-size --eye --look-at --up --field-of-view-deg --material --kernel --irradiance --areas --output --resume --threads --quiet --verbose --progress --save --no-history --generate --list --help --version"
            if [[ ${cur} == -* || ${COMP_CWORD} -eq 1 ]] ; then
                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
                return 0
            fi
            case "${prev}" in
                --reflectance)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --panel-reflectance)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --facet-reflectance)
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
                --reference-panel)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --bounces)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --exposure)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --noise-sd)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --photon-noise)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --seed)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --gloss)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --gloss-roughness)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --body-roughness-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --fuzz)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --render)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --render-size)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --eye)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --look-at)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --up)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --field-of-view-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --material)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --kernel)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --irradiance)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --areas)
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
    complete -F _vforward -o nosort -o bashdefault -o default vforward
else
    complete -F _vforward -o bashdefault -o default vforward
fi

