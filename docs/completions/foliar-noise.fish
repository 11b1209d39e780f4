complete -c foliar-noise -s o -l output -d 'Output: .png (16 bits), .exr (every bit), .layer, or - for a PNG on standard output' -r -F
complete -c foliar-noise -l beta -d 'Slope of the power spectrum in time, 1/f^beta: 1 is pink, 2 is brown. A straight way through a field in the plane has the power of the field less one, so the field itself falls with beta + 1. [at least 0.5, at most 4, default 2.0]' -r
complete -c foliar-noise -l size -d 'Texels along each edge. [at least 32, at most 2048, default 256]' -r
complete -c foliar-noise -l kmin -d 'Lowest waves per tile: 2 or 3 where one row alone would look periodic. [at least 1, at most 64, default 1]' -r
complete -c foliar-noise -l kmax -d 'Highest waves per tile, below half the size: times tiles per second it is the fastest sway in hertz. Near half the size, filtering between texels loses much of it. [at least 8, at most 1024, default 32]' -r
complete -c foliar-noise -l seed -d 'Which of all such textures. [at least 0, at most 4294967295, default 1]' -r
complete -c foliar-noise -l set -d 'Gives any parameter, such as density.radius_m=0.3; `foliar config` lists all' -r
complete -c foliar-noise -l config -d 'Reads this configuration instead of the project\'s foliar.toml' -r -F
complete -c foliar-noise -l outputs -d 'Writes the list of files that belong to the output' -r -F
complete -c foliar-noise -l report -d 'Writes what was read, found, made and measured' -r -F
complete -c foliar-noise -l depfile -d 'Writes every file that was really read, as a rule for make or ninja' -r -F
complete -c foliar-noise -l fail-on -d 'Findings as serious as this end the work with status 1, the old output left as it is' -r -f -a "note\t''
warning\t''
error\t''"
complete -c foliar-noise -l threads -d 'Works in so many threads; the result is the same for any number' -r
complete -c foliar-noise -l format -d 'How results are printed: for people, as JSON lines, or the findings for machines that show them' -r -f -a "human\t''
json\t''
sarif\t''
junit\t''
github\t''"
complete -c foliar-noise -l measure -d 'Prints what was measured on it'
complete -c foliar-noise -l no-config -d 'Reads neither foliar.toml nor the asset\'s own file'
complete -c foliar-noise -l dry-run -d 'Prints what would be done and stops'
complete -c foliar-noise -l check -d 'Writes nothing; status 1 where the output would change'
complete -c foliar-noise -s q -l quiet -d 'Prints errors only'
complete -c foliar-noise -s v -l verbose -d 'Prints each step with its time'
complete -c foliar-noise -s h -l help -d 'Print help'
complete -c foliar-noise -s V -l version -d 'Print version'
