#!/usr/bin/env bash
# Ends renders by kill -9 at random moments, lets each go on from its checkpoint, and compares bits with one that was never interrupted:
#   kills.sh [KILLS] [PROGRAM]    200 if not said, shared among five kinds of renders
# While settings are searched there is no checkpoint yet; after that two renders that go on from one must agree. The fifth kind searches, too,
# but gets SIGTERM: its image must be that of its checkpoint, and it begins anew every other time, to be ended while it searches.
set -euo pipefail
cd "$(dirname "$0")/.."
kills=${1:-200}
program=$(realpath "${2:-build/release/quasilux}")
scenes=$PWD/scenes
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
RANDOM=24
failed=0

fail() {
    echo "kills.sh: $*"
    failed=$((failed + 1))
}

passesOf() { "$program" merge "$1" -o passes.exr --json | sed -nE 's/^ *"passes": ([0-9]+).*/\1/p'; }

# arguments KIND: the arguments that the kind of render is begun with.
arguments() {
    case $1 in
        photons) echo "$scenes/cornell_phong.xml -D resolution=24 --fixed --photons 2000" ;;
        camera) echo "$scenes/cornell_phong.xml -D resolution=24 --fixed --photons 2000 --map camera" ;;
        grid) echo "$scenes/daylight_room.xml --fixed --photons 2000 --grid NAME.csv" ;;
        search | ended) echo "$scenes/cornell_phong.xml -D resolution=24 --time 100" ;;
    esac
}

# optionsOf NAME KIND: sets `words`.
optionsOf() {
    read -ra words <<<"$(arguments "$2")"
    words=("${words[@]//NAME/$1}" -o "$1.exr" --quiet) # which still says that no checkpoint is written
}

# renders NAME KIND OPTION...
renders() {
    optionsOf "$1" "$2"
    "$program" render "${words[@]}" "${@:3}" >/dev/null
}

# secondsToCheckpoint KIND: twice as long as it takes until there is one, and two seconds more: moments before and after it are as likely.
secondsToCheckpoint() {
    local start more=()
    searches "$1" || more=(--passes 1000000)
    optionsOf first "$1"
    start=$(date +%s%N)
    "$program" render "${words[@]}" "${more[@]}" --checkpoint first.ckpt --every 0 >/dev/null 2>&1 &
    while [[ ! -e first.ckpt ]]; do
        kill -0 $! || { echo "kills.sh: the program ended before its first checkpoint" >&2; exit 1; }
        sleep 0.05
    done
    kill -9 $!
    wait $! 2>/dev/null || true
    awk -v ns=$(($(date +%s%N) - start)) 'BEGIN { print 2e-9 * ns + 2 }'
    rm -f first.ckpt first.ckpt.*
}

searches() { [[ $1 == search || $1 == ended ]]; }

sameImages() {
    oiiotool "$1.exr" "$2.exr" --fail 0 --warn 0 --diff >/dev/null 2>&1 || return 1
    [[ ! -e $1.csv ]] || cmp -s <(grep -v '^#' "$1.csv") <(grep -v '^#' "$2.csv")
}

# checkEnded CODE: after SIGTERM; where the search had chosen nothing, it says so, and there is an image at most.
checkEnded() {
    (($1 == 143)) || fail "ended: code $1 after SIGTERM, expected 143: $(cat log)"
    if [[ -e ended.ckpt ]]; then # without an image where the first pass was not over
        [[ ! -e ended.exr ]] || sameImages ended check || fail "ended: the image is not that of the checkpoint"
    elif [[ -e ended.exr ]]; then
        grep -q 'no checkpoint' log || fail "ended: an image, no checkpoint, and no word of it: $(cat log)"
        saysSo=$((saysSo + 1))
    fi
}

kinds=(photons camera grid search ended)
for kind in "${kinds[@]}"; do
    killed=0 with=0 saysSo=0 signal=KILL
    [[ $kind != ended ]] || signal=TERM
    longest=$(secondsToCheckpoint "$kind")
    for ((k = 0; k < kills / ${#kinds[@]}; ++k)); do
        options=(--checkpoint "$kind.ckpt" --every 0)
        searches "$kind" || options+=(--passes 1000000)
        if [[ $kind == ended ]]; then
            ((k % 2)) || rm -f ended.ckpt ended.ckpt.*
            rm -f ended.exr
        fi
        [[ ! -e $kind.ckpt ]] || options+=(--resume "$kind.ckpt")
        optionsOf "$kind" "$kind"
        "$program" render "${words[@]}" "${options[@]}" >/dev/null 2>log &
        sleep "$(awk -v longest="$longest" -v share=$((RANDOM % 1000)) 'BEGIN { print longest * share / 1000 }')"
        kill -$signal $! 2>/dev/null || true
        code=0
        wait $! 2>/dev/null || code=$?
        ((code)) || fail "$kind: it ended before it was killed"
        [[ ! -s log ]] || ! grep -q 'quasilux: error' log || fail "$kind: $(cat log)"
        killed=$((killed + 1))
        if [[ -e $kind.ckpt && ($kind != ended || -e ended.exr) ]]; then
            with=$((with + 1))
            "$program" merge "$kind.ckpt" -o check.exr --quiet || fail "$kind: the checkpoint is damaged after $killed kills"
            cp "$kind.ckpt" last.ckpt
        fi
        [[ $kind != ended ]] || checkEnded "$code"
    done
    [[ $kind != ended || ! -e last.ckpt ]] || cp last.ckpt "$kind.ckpt" # the last one began anew
    rm -f last.ckpt
    if [[ ! -e $kind.ckpt ]]; then
        fail "$kind: there is no checkpoint"
        continue
    fi
    passes=$(($(passesOf "$kind.ckpt") + 5))
    renders a "$kind" --passes "$passes" --resume "$kind.ckpt"
    if searches "$kind"; then
        renders b "$kind" --passes "$passes" --resume "$kind.ckpt"
    else
        renders b "$kind" --passes "$passes"
    fi
    if sameImages a b; then same="the same bits"; else same="OTHER BITS"; fi
    [[ $same == "the same bits" ]] || fail "$kind: other bits after $passes passes"
    # Control: a pass less is another image.
    if ! searches "$kind"; then
        renders b "$kind" --passes $((passes - 1))
        ! sameImages a b || fail "$kind: the comparison sees nothing"
    fi
    echo "$kind: $signal $killed times, $with with a checkpoint, $saysSo that say why there is none; after $passes passes $same"
    leftover=$(find . -name '*.tmp' | wc -l)
    ((leftover <= 2 * ${#kinds[@]})) || fail "$kind: $leftover temporary files"
done
exit $((failed > 0))
