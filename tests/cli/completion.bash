# Completes command lines as bash does, by the script that the program prints, and as zsh does where it is
# installed.
#
# usage: bash completion.bash GEODISK
set -euo pipefail

geodisk=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir scans
touch bunny.obj mesh.ply

fail() {
    echo "completion: $*" >&2
    exit 1
}

"$geodisk" completion bash > geodisk.bash
source ./geodisk.bash
[ "$(complete -p geodisk)" = "complete -F _geodisk geodisk" ] || fail "bash does not know geodisk"

# What a line is completed to; "FILES" and "FOLDERS" where bash completes these itself.
compopt() {
    case "$*" in
        "-o default") COMPREPLY=(FILES) ;;
        "-o dirnames") COMPREPLY=(FOLDERS) ;;
    esac
}
expect() { # LINE COMPLETION...
    COMP_LINE=$1 COMP_POINT=${#1}
    shift
    _geodisk
    [ "${COMPREPLY[*]-}" = "$*" ] || fail "'$COMP_LINE' gives '${COMPREPLY[*]-}', not '$*'"
}
expect 'geodisk sam' sample
expect 'geodisk s' sample spectrum shapes
expect 'geodisk bun' FILES
expect 'geodisk --v' --version
expect 'geodisk sample --co' --count --coordinates --columns
expect 'geodisk sample bunny.obj -d 1 --pool' --pool-ratio
expect 'geodisk sample --format ' ply csv xyz npz pcd obj gltf glb usda vtp star
expect 'geodisk sample --format g' gltf glb
expect 'geodisk sample --format=n' npz
expect 'geodisk sample --seed '
expect 'geodisk sample -o ' FILES
expect 'geodisk sample --ascii m' FILES
expect 'geodisk sample bui' $("$geodisk" shapes | sed -n 's/^\(builtin:[^ ]*\).*/\1/p' | sort)
expect 'geodisk sample builtin:tor' torus-knot
expect 'geodisk verify bunny.obj ' FILES
expect 'geodisk batch scans -o ' FOLDERS
expect 'geodisk render --style v' voronoi
expect 'geodisk bunny.obj --cou' --count
expect 'geodisk bunny.obj --format ' ply csv xyz npz pcd obj gltf glb usda vtp star
expect 'geodisk sample -n 9 -- --co' FILES

if ! command -v zsh > /dev/null; then
    echo "completion: zsh is not installed, so its script is not tried"
    exit 0
fi
mkdir functions
"$geodisk" completion zsh > functions/_geodisk
# A shell on a terminal of its own, whose prompt tells that it is ready. A list of choices shows what it
# would insert.
cat > try.zsh << 'END'
zmodload zsh/zpty
zpty shell zsh -f -i
send() { zpty -w shell "$1" }
until_seen() { # PATTERN
    local seen= more
    while [[ $seen != $~1 ]]; do
        zpty -r -t shell more || { sleep 0.05; ((++waits < 400)) || { print -r "$seen"; return 1 } }
        seen+=${more//[^[:print:]]/} more= # Bells and other signals may be within.
    done
}
send "PS1='rea''dy '; fpath=($PWD/functions \$fpath); autoload -Uz compinit; compinit -D -u"
until_seen '*ready *' || exit 1
for line wanted (
    'geodisk sam' 'geodisk sample'
    'geodisk sample --format np' 'geodisk sample --format npz'
    'geodisk sample builtin:torus' 'geodisk sample builtin:torus-knot'
    'geodisk sample --coo' '--coordinates'
    'geodisk sample mes' 'geodisk sample mesh.ply'
); do
    zpty -n -w shell "$line"$'\t'
    waits=0
    until_seen "*$wanted*" || { print "zsh does not complete '$line' to '$wanted'"; exit 1 }
    zpty -n -w shell $'\x15' # Empties the line.
done
zpty -d shell
END
zsh -f try.zsh || fail "zsh"
