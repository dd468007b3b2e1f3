#!/usr/bin/env bash
# paper_section.sh SOURCE PROGRAM: makes the section of docs/paper_section of a small experiment.
# Exit code 77, with the reason, where there is no LaTeX.
set -euo pipefail
source=$1 program=$2
command -v pdflatex >/dev/null || { echo "skipped: pdflatex is not installed"; exit 77; }
kpsewhich booktabs.sty >/dev/null || { echo "skipped: LaTeX lacks booktabs"; exit 77; }
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
VITRUVIA=$program EXPERIMENT=$source/configs/examples/ablation.json "$source/docs/paper_section/make.sh" "$out"
head -c 5 "$out/section.pdf" | grep -q '%PDF-'
! grep -q 'undefined references' "$out/section.log"
