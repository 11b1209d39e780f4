_foliar__view() {
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
                cmd="foliar__view"
                ;;
            *)
                ;;
        esac
    done

    case "${cmd}" in
        foliar__view)
            opts="-o -q -v -h -V --output --sheet --channels --against --light-through --turntable --sway --up --height-m --node --scene --expand-instances --search --texture --leaf --wood --other --width-px --height-px --samples --look --line-normals --line-angle-deg --line-width-px --line-detail-px --neighbor --channel --azimuth-deg --elevation-deg --fov-deg --target-m --distance-m --sun-azimuth-deg --sun-elevation-deg --exposure --background --ground --scale --unit --set --config --no-config --dry-run --check --outputs --report --depfile --fail-on --threads --quiet --verbose --format --help --version"
            if [[ ${cur} == -* || ${COMP_CWORD} -eq 1 ]] ; then
                COMPREPLY=( $(compgen -W "${opts}" -- "${cur}") )
                return 0
            fi
            case "${prev}" in
                --output)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                -o)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --against)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --light-through)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --turntable)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --sway)
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
                --width-px)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --height-px)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --samples)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --look)
                    COMPREPLY=($(compgen -W "plain baked stock lines light traced" -- "${cur}"))
                    return 0
                    ;;
                --line-normals)
                    COMPREPLY=($(compgen -W "plain baked" -- "${cur}"))
                    return 0
                    ;;
                --line-angle-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --line-width-px)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --line-detail-px)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --neighbor)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --channel)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --azimuth-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --elevation-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --fov-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --target-m)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --distance-m)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --sun-azimuth-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --sun-elevation-deg)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --exposure)
                    COMPREPLY=($(compgen -f "${cur}"))
                    return 0
                    ;;
                --background)
                    COMPREPLY=($(compgen -W "studio white black clear" -- "${cur}"))
                    return 0
                    ;;
                --ground)
                    COMPREPLY=($(compgen -W "shadow none" -- "${cur}"))
                    return 0
                    ;;
                --scale)
                    COMPREPLY=($(compgen -W "person bar none" -- "${cur}"))
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
    complete -F _foliar__view -o nosort -o bashdefault -o default foliar-view
else
    complete -F _foliar__view -o bashdefault -o default foliar-view
fi
