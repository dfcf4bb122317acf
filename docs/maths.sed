# Formulas between dollars, as pages have them, become Doxygen's; blocks of code stay.
/^```/,/^```/b
/^    /b
s/\$\$([^$]+)\$\$/\\f[\1\\f]/g
s/\$([^$`]+)\$/\\f$\1\\f$/g
