_vestimate() {
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
                cmd="vestimate"
                ;;
            *)
                ;;
        esac
    done

    case "${cmd}" in
        vestimate)
            opts="-o -j -q -v -h -V --prior --smoothness --noise-sd --model-error --exposure --fit --join --illuminants --known-fold --backed --start --plot --spectra --trace --method --components --basis --plan --material --kernel --irradiance --areas --output --resume --threads --quiet --verbose --progress --save --no-history --generate --list --percent --camera --illuminant --sky-illuminant --reflectance --reference-panel --help --version"
            if [[ ${cur} == -* || ${COMP_CWORD} -eq 1 ]] ; then
                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
                return 0
            fi
            case "${prev}" in
                --prior)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --smoothness)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --noise-sd)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --model-error)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --exposure)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --fit)
                    COMPREPLY=($(compgen -W "exposure angle tilt sky daylight auto none" -- "${cur}"))
                    return 0
                    ;;
                --join)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --illuminants)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --known-fold)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --start)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --plot)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --spectra)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --trace)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --method)
                    COMPREPLY=($(compgen -W "interreflection park khan" -- "${cur}"))
                    return 0
                    ;;
                --components)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --basis)
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
                --percent)
                    COMPREPLY=($(compgen -W "true false" -- "${cur}"))
                    return 0
                    ;;
                --camera)
                    COMPREPLY=($(compgen -f -W "canon-5d-mark-ii nikon-d5100 sigma-sd-merrill arashi-vision-insta360-x5 arri-d21 canon-digital-rebel-xti canon-eos-100d canon-eos-200d canon-eos-200d-ii canon-eos-5d canon-eos-5d-mark-ii canon-eos-5d-mark-iii canon-eos-5d-mark-iv canon-eos-5ds canon-eos-600d canon-eos-m canon-eos-r canon-eos-r10 canon-eos-r5 canon-eos-r5m2 canon-eos-r6 canon-eos-r6m2 canon-eos-rp canon-eos-1d-x-mark-ii canon-eos-1ds-mark-ii canon-eos-1ds-mark-iii canon-powershot-s90 fujifilm-gfx-100 fujifilm-x-t3 fujifilm-x-t4 hasselblad-l1d-20c hasselblad-l2d-20c nikon-d200 nikon-d3300 nikon-d5300 nikon-d70 nikon-d700 nikon-d7000 nikon-d800e nikon-d810 nikon-d850 nikon-z-f panasonic-dc-gx9 sony-dsc-rx100m4 sony-ilce-6400 sony-ilce-7cm2 sony-ilce-7m3 sony-ilce-7m4 sony-ilce-7rm2 sony-ilce-7rm3 sony-ilce-7rm4 sony-ilce-7sm2 sony-ilce-7sm3 sony-ilce-9" -- "${cur}"))
                    return 0
                    ;;
                --illuminant)
                    COMPREPLY=($(compgen -f -W "A D50 D55 D60 D65 D75 E FL1 FL2 FL3 FL4 FL5 FL6 FL7 FL8 FL9 FL10 FL11 FL12 FL3.1 FL3.2 FL3.3 FL3.4 FL3.5 FL3.6 FL3.7 FL3.8 FL3.9 FL3.10 FL3.11 FL3.12 FL3.13 FL3.14 FL3.15 LED-B1 LED-B2 LED-B3 LED-B4 LED-B5 LED-BH1 LED-RGB1 LED-V1 LED-V2 LCD-R LCD-G LCD-B" -- "${cur}"))
                    return 0
                    ;;
                --sky-illuminant)
                    COMPREPLY=($(compgen -f -W "A D50 D55 D60 D65 D75 E FL1 FL2 FL3 FL4 FL5 FL6 FL7 FL8 FL9 FL10 FL11 FL12 FL3.1 FL3.2 FL3.3 FL3.4 FL3.5 FL3.6 FL3.7 FL3.8 FL3.9 FL3.10 FL3.11 FL3.12 FL3.13 FL3.14 FL3.15 LED-B1 LED-B2 LED-B3 LED-B4 LED-B5 LED-BH1 LED-RGB1 LED-V1 LED-V2 LCD-R LCD-G LCD-B" -- "${cur}"))
                    return 0
                    ;;
                --reflectance)
                    COMPREPLY=($(compgen -f -W "cc24 cc24-babelcolor cc24-iso17321 munsell" -- "${cur}"))
                    return 0
                    ;;
                --reference-panel)
                    COMPREPLY=($(compgen -f -W "cc24 cc24-babelcolor cc24-iso17321 munsell" -- "${cur}"))
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
    complete -F _vestimate -o nosort -o bashdefault -o default vestimate
else
    complete -F _vestimate -o bashdefault -o default vestimate
fi

