# Spectra on any grid: a reflectance by 50 nm, a one-channel camera, a lamp of two lines; names with a colon pick a column.
cat > sheet.csv <<END
wavelength,matte,gloss
390,0.1,0.2
550,0.5,0.4
740,0.9,0.8
END
printf 'nm,grey\n380,1\n720,1\n' > camera.csv
printf 'nm,power\n400,0\n449,0\n450,1\n451,0\n649,0\n650,1\n651,0\n700,0\n' > lamp.csv
vkernel --angle-deg 180 --facets 1x1 --no-history |
    vforward --reflectance sheet.csv:matte --camera camera.csv --illuminant lamp.csv --wavelengths-nm 400:700:10 --no-history |
    grep '"kind":"sample"'
