# No facet hands on more light than it has: true of the exact form factors, and of rays counted where they land, not of eq. (2)
# at the facets' centres, whose bounces diverge for sheets lighter than 1/1.926 = 0.52.
vkernel --check
vkernel --check --method monte-carlo --sampling cosine --samples 2000 --seed 7
vkernel --check --method midpoint --save kernel=K.npy 2>says || { test $? = 1; cat says; }
python3 -c 'import numpy; print(numpy.abs(numpy.linalg.eigvalsh(numpy.load("K.npy"))).max())'
# A scene says how its form factors were found.
vkernel --angle-deg 90 --facets 1x1 --method monte-carlo --samples 100 --seed 1 --no-history -q
