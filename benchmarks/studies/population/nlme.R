# SPDX-License-Identifier: MIT
# Theophylline by R's nlme (Pinheiro and Bates), from the closed form of the concentration:
# Rscript nlme.R examples/theophylline/theophylline.csv > results/nlme.csv
library(nlme)
file <- commandArgs(trailingOnly = TRUE)[1]
data <- read.csv(file, comment.char = "#", check.names = FALSE)
names(data) <- c("subject", "t", "conc", "dose", "weight")
data$subject <- factor(data$subject)
one <- function(dose, t, lka, lCL, lV) {
  ka <- exp(lka)
  V <- exp(lV)
  ke <- exp(lCL) / V
  dose * ka / (V * (ka - ke)) * (exp(-ke * t) - exp(-ka * t))
}
fitted <- nlme(conc ~ one(dose, t, lka, lCL, lV), data = data, fixed = lka + lCL + lV ~ 1,
               random = pdDiag(lka + lCL + lV ~ 1), groups = ~subject,
               start = c(lka = log(1.5), lCL = log(0.04), lV = log(0.5)), method = "ML",
               control = nlmeControl(tolerance = 1e-8, pnlsTol = 1e-5, maxIter = 200,
                                     msMaxIter = 200))
spreads <- as.numeric(VarCorr(fitted)[, "StdDev"])
cat("quantity,value,stderr\n")
for (i in 1:3) {
  name <- c("ka", "CL", "V")[i]
  value <- exp(fixef(fitted)[i])
  cat(sprintf("%s,%.6g,%.4g\n", name, value, value * sqrt(vcov(fitted)[i, i])))
  cat(sprintf("spread of log %s,%.6g,\n", name, spreads[i]))
}
cat(sprintf("noise,%.6g,\n", fitted$sigma))
cat(sprintf("log-likelihood,%.7g,\n", as.numeric(logLik(fitted))))
own <- exp(coef(fitted))
for (s in as.character(1:12))
  cat(sprintf("subject %s: ka %.5g CL %.5g V %.5g,,\n", s, own[s, 1], own[s, 2], own[s, 3]))
