#!/bin/sh
# Draws the pictures of the documentation again: times are those of this machine.
set -eu
cd "$(dirname "$0")/../.."
cargo build --release
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
target/release/krawl compare problems/icosahedron-c1.toml --sweep --repeat 25 --output "$folder"
mv "$folder"/icosahedron-c1-cost.svg "$folder"/icosahedron-c1-time.svg "$folder"/icosahedron-c1-path.svg docs/pictures/
target/release/krawl solve problems/octahedron.toml --quiet --animation docs/pictures/octahedron-moving.svg
# The bracket, without the names of its points (several are in one place) and the lines through its edges.
target/release/krawl edit problems/sketches/bracket.slvs --set c008=64 --quiet --svg "$folder/bracket.svg"
grep -vE 'stroke-dasharray|>r0[0-9a-f.]*</text>' "$folder/bracket.svg" >docs/pictures/bracket-edit.svg
target/release/krawl tolerance docs/examples/hinge.toml --quiet --svg docs/pictures/hinge-bands.svg
