# Two squares at a right angle exchange 0.2000438 of their light: the fold's only pole (Howell, configuration C-14).
vkernel --angle-deg 90 --facets 1x1 --mesh facets --no-history
