#!/bin/sh
# The rules of the house that no compiler knows. Prints file:line: what is wrong.
#   lint.sh [ROOT]
set -u
cd "${1:-$(dirname "$0")/..}" || exit 2
bad=0

sources=$(find src include tests -name '*.c' -o -name '*.h' -o -name '*.cpp' | sort)
scripts=$(find tests .ci -name '*.sh' -o -path .ci/run | sort)

# A file includes only its own floor or a lower one: the house stands, and a floor can be read
# without those above it.
# shellcheck disable=SC2086  # lists of files without blanks
awk '
    BEGIN { n = split("base geometry motion figure garment dress files app", names)
            for (i = 1; i <= n; i++) floor[names[i]] = i }
    FNR == 1 { split(FILENAME, part, "/"); own = part[2] }
    part[1] == "tests" { next }
    FNR == 1 && !(own in floor) { print FILENAME ": no floor is called " own; bad = 1 }
    match($0, /^[ \t]*#[ \t]*include[ \t]*"[^"]+"/) {
        name = substr($0, RSTART, RLENGTH); sub(/^[^"]*"/, "", name); sub(/"$/, "", name)
        split(name, target, "/")
        if (!(target[1] in floor)) { print FILENAME ":" FNR ": \"" name "\" names no floor"; bad = 1 }
        else if (floor[target[1]] > floor[own]) {
            print FILENAME ":" FNR ": " own " includes " name ", a higher floor"; bad = 1 }
    }
    END { exit bad }' $sources || bad=1

# Own header first, so that each header proves that it stands alone.
for f in $(find src -name '*.c' | sort); do
    own=${f#src/} own=${own%.c}.h
    [ -f "include/$own" ] || continue
    first=$(sed -n 's/^#include *//p' "$f" | head -n 1)
    [ "$first" = "\"$own\"" ] || { echo "$f: begin with #include \"$own\""; bad=1; }
done

# shellcheck disable=SC2086
awk '
    function say(what) { print FILENAME ":" FNR ": " what; bad = 1 }
    FNR == 1 && !/^\/\*/ { say("the file does not begin with its purpose") }
    FNR == 501 { say("more than 500 lines: is there a second purpose inside?") }
    length($0) > 120 { say("more than 120 columns") }
    /\t/ { say("a tab") }
    /[ \t\r]$/ { say("a blank at the end of the line") }
    /TODO|FIXME/ { say("unfinished: " $0) }
    END { exit bad }' $sources || bad=1

# shellcheck disable=SC2086
awk '
    function say(what) { print FILENAME ":" FNR ": " what; bad = 1 }
    length($0) > 120 { say("more than 120 columns") }
    /[ \t\r]$/ { say("a blank at the end of the line") }
    END { exit bad }' $scripts || bad=1

# Nobody below main ends the program, and none sets a locale: numbers have a point everywhere.
# shellcheck disable=SC2046
grep -HnE '(^|[^_a-zA-Z])(exit|abort|setlocale|system|gets|strcpy|strcat|sprintf|atoi|atof) *\(' \
    $(find src -name '*.c' -o -name '*.cpp' | sort) | grep -v '^src/app/main.c:[0-9]*:.* exit *(' && bad=1

# prove runs tests as they are, so they must be programs.
for f in tests/*.sh .ci/run; do
    case $f in tests/lib.sh) continue ;; esac
    [ -x "$f" ] || { echo "$f: not executable"; bad=1; }
    sh -n "$f" 2>/dev/null || bash -n "$f" || bad=1
done

# Only what was agreed on stands at the top.
for f in *; do
    case $f in
    Makefile | src | include | motions | garments | tests | README.md | LICENSE | build) ;;
    *) echo "$f: not agreed on at the top level"; bad=1 ;;
    esac
done
exit $bad
