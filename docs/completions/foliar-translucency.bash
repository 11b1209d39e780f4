_foliar__translucency() {
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
                cmd="foliar__translucency"
                ;;
            *)
                ;;
        esac
    done

    case "${cmd}" in
        foliar__translucency)
            opts="-d -q -v -o -h -V --directory --keep-going --picture --cache --explain-roles --up --height-m --node --scene --expand-instances --search --texture --leaf --wood --other --thickness --alpha --normal-front --normal-back --height-front --height-back --backlit --material --for-material --leaf-width-mm --texel-mm --texel-height-mm --thickness-scale-mm --thickness-offset-mm --thickness-from --thickness-mean-mm --veins --height-scale-mm --preset --wavelength-nm --bands --absorption --reduced-scattering --anisotropy --index --fit-rt --mirror --layer --model --entry --fit --curve --spread --filters --normalize --sides --normal-frame --normal-y --coarsest-mm --exr --embed-all --unit --set --config --no-config --dry-run --check --outputs --report --depfile --fail-on --threads --quiet --verbose --format --output --help --version"
            if [[ ${cur} == -* || ${COMP_CWORD} -eq 1 ]] ; then
                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
                return 0
            fi
            case "${prev}" in
                --directory)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                -d)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --picture)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --cache)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --up)
                    COMPREPLY=($(compgen -W "y z" -- "${cur}"))
                    return 0
                    ;;
                --height-m)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --node)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --scene)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --expand-instances)
                    COMPREPLY=($(compgen -W "true false" -- "${cur}"))
                    return 0
                    ;;
                --search)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --texture)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --leaf)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --wood)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --other)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --thickness)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --alpha)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --normal-front)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --normal-back)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --height-front)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --height-back)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --backlit)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --material)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --for-material)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --leaf-width-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --texel-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --texel-height-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --thickness-scale-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --thickness-offset-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --thickness-from)
                    COMPREPLY=($(compgen -W "map photo" -- "${cur}"))
                    return 0
                    ;;
                --thickness-mean-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --veins)
                    COMPREPLY=($(compgen -W "auto light dark" -- "${cur}"))
                    return 0
                    ;;
                --height-scale-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --preset)
                    COMPREPLY=($(compgen -W "typical young dark senescent" -- "${cur}"))
                    return 0
                    ;;
                --wavelength-nm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --bands)
                    COMPREPLY=($(compgen -W "one rgb" -- "${cur}"))
                    return 0
                    ;;
                --absorption)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --reduced-scattering)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --anisotropy)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --index)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --fit-rt)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --mirror)
                    COMPREPLY=($(compgen -W "included excluded" -- "${cur}"))
                    return 0
                    ;;
                --layer)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --model)
                    COMPREPLY=($(compgen -W "multipole diffusion adding-doubling" -- "${cur}"))
                    return 0
                    ;;
                --entry)
                    COMPREPLY=($(compgen -W "lambert fresnel transport" -- "${cur}"))
                    return 0
                    ;;
                --fit)
                    COMPREPLY=($(compgen -W "uniform cosine anchor" -- "${cur}"))
                    return 0
                    ;;
                --curve)
                    COMPREPLY=($(compgen -W "straight fitted" -- "${cur}"))
                    return 0
                    ;;
                --spread)
                    COMPREPLY=($(compgen -W "none kernel" -- "${cur}"))
                    return 0
                    ;;
                --filters)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --normalize)
                    COMPREPLY=($(compgen -W "none mean diffuse" -- "${cur}"))
                    return 0
                    ;;
                --sides)
                    COMPREPLY=($(compgen -W "front back both" -- "${cur}"))
                    return 0
                    ;;
                --normal-frame)
                    COMPREPLY=($(compgen -W "same-uv-mirrored right-handed" -- "${cur}"))
                    return 0
                    ;;
                --normal-y)
                    COMPREPLY=($(compgen -W "up down" -- "${cur}"))
                    return 0
                    ;;
                --coarsest-mm)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --exr)
                    COMPREPLY=($(compgen -W "half float" -- "${cur}"))
                    return 0
                    ;;
                --embed-all)
                    COMPREPLY=($(compgen -W "true false" -- "${cur}"))
                    return 0
                    ;;
                --unit)
                    COMPREPLY=($(compgen -W "m cm mm in ft" -- "${cur}"))
                    return 0
                    ;;
                --set)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --config)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --outputs)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --report)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --depfile)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --fail-on)
                    COMPREPLY=($(compgen -W "note warning error" -- "${cur}"))
                    return 0
                    ;;
                --threads)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --format)
                    COMPREPLY=($(compgen -W "human json sarif junit github" -- "${cur}"))
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
    complete -F _foliar__translucency -o nosort -o bashdefault -o default foliar-translucency
else
    complete -F _foliar__translucency -o bashdefault -o default foliar-translucency
fi
