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
