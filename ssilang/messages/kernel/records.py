"""What ssilang/kernel/records refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "record-correct-needs-four": Message(
        "a record to correct needs four points at least, found {n}",
        "un enregistrement à corriger a au moins quatre points, il y en a {n}",
    ),
    "power-spectrum-not-negative": Message(
        "a power spectrum is not negative",
        "un spectre de puissance n'est pas négatif",
    ),
    "recording-time-shock-must": Message(
        "the recording time of a shock must be positive",
        "la durée d'acquisition d'un choc doit être positive",
    ),
    "frequencies-begin-constant-step": Message(
        "the frequencies begin at 0 and have a constant step",
        "les fréquences partent de 0 et vont par pas constant",
    ),
    "frequencies-not-split-groups": Message(
        "{n_omega} frequencies do not split into groups of {group}",
        "{n_omega} fréquences ne se partagent pas en groupes de {group}",
    ),
    "elastic-limit-oscillator-must": Message(
        "the elastic limit of an oscillator must be positive",
        "la limite élastique d'un oscillateur doit être positive",
    ),
    "ductility-least": Message(
        "a ductility is at least 1 ({ductility:g})",
        "une ductilité vaut au moins 1 ({ductility:g})",
    ),
    "signal-times-must-go": Message(
        "the signal's times must go by equal steps",
        "les temps du signal doivent aller par pas égaux",
    ),
    "frequency-oscillator-must-positive": Message(
        "the frequency of an oscillator must be positive",
        "la fréquence d'un oscillateur doit être positive",
    ),
    "damping-oscillator-cannot-negative": Message(
        "the damping of an oscillator cannot be negative ({damping:g})",
        "l'amortissement d'un oscillateur ne peut être négatif ({damping:g})",
    ),
    "hardening-ratio-lies-left": Message(
        "the hardening ratio lies from 0 to 1, 1 left out ({hardening:g})",
        "le rapport d'écrouissage va de 0 à 1, 1 exclu ({hardening:g})",
    ),
    "damping-between-not": Message(
        "damping is between 0 and 1, not {damping:g}",
        "un amortissement est entre 0 et 1, pas {damping:g}",
    ),
    "duration-periods-must-positive": Message(
        "the duration and the periods must be positive",
        "la durée et les périodes doivent être positives",
    ),
    "power-spectrum-positive-over": Message(
        "a power spectrum is positive, over increasing frequencies",
        "un spectre de puissance est positif, sur des fréquences croissantes",
    ),
    "largest-response-spectrum-no": Message(
        "the largest response of this spectrum has no finite fractile",
        "la réponse maximale de ce spectre n'a pas de fractile fini",
    ),
    "frequencies-spectrum-duration-positive": Message(
        "the frequencies of a spectrum and the duration are positive",
        "les fréquences d'un spectre et la durée sont positives",
    ),
    "mode-frequency-damping-participation": Message(
        "each mode has a frequency, a damping and a participation",
        "chaque mode a une fréquence, un amortissement et une participation",
    ),
    "frequencies-modes-positive": Message(
        "the frequencies of modes are positive",
        "les fréquences des modes sont positives",
    ),
    "least-process-instant-needed": Message(
        "at least one process and one instant are needed, and a precision above 0",
        "il faut au moins un processus et un instant, et une précision positive",
    ),
    "modulations-need-increasing-limits": Message(
        "{n_times} modulations need {n_times_2} increasing limits of bands, not {n_bands}",
        "{n_times} modulations demandent {n_times_2} limites de bandes croissantes, pas {n_bands}",
    ),
    "modulations-not-go-instant": Message(
        "the modulations do not go from one instant to another, all alike",
        "les modulations ne vont pas toutes d'un même instant à un même autre",
    ),
    "frequencies-values-function": Message(
        "{n_omega} {n_omega:frequency|frequencies} for {n_values} {n_values:value|values} of "
        "the function",
        "{n_omega} {n_omega:fréquence|fréquences} pour {n_values} {n_values:valeur|valeurs} "
        "de la fonction",
    ),
    "acceleration-needs-two-points": Message(
        "the acceleration needs two points, a positive step and cut-off frequency",
        "l'accélération demande deux points, un pas et une fréquence de coupure positifs",
    ),
    "depth-outside-layers-end": Message(
        "a depth is outside the layers, which end at {bottom:g} m",
        "une profondeur est hors des couches, qui finissent à {bottom:g} m",
    ),
    "frequencies-rayleigh-damping-must": Message(
        "the frequencies of Rayleigh's damping must be positive",
        "les fréquences de l'amortissement de Rayleigh doivent être positives",
    ),
    "signal-needs-two-points": Message(
        "a signal needs two points at least, found {n_x}",
        "un signal demande deux points au moins, trouvé {n_x}",
    ),
    "soil-needs-many-thicknesses": Message(
        "a soil needs as many thicknesses as densities, moduli and dampings",
        "un sol demande autant d'épaisseurs que de masses volumiques, de modules et "
        "d'amortissements",
    ),
    "thickness-density-modulus-layer": Message(
        "thickness, density and modulus of a layer must be positive",
        "l'épaisseur, la masse volumique et le module d'une couche doivent être positifs",
    ),
    "abscissas-not-regularly-spaced": Message(
        "the abscissas are not regularly spaced: steps differ by {worst:g} from {step:g}",
        "les abscisses ne sont pas à pas constant : des pas s'écartent de {worst:g} de la "
        "valeur {step:g}",
    ),
    "filter-order": Message(
        "the order of a filter is from 1 to 12, not {order}",
        "l'ordre d'un filtre est entre 1 et 12, pas {order}",
    ),
    "filter-corner": Message(
        "a corner of {corner:g} Hz: it must be above 0 and below {nyquist:g} Hz, half the record's "
        "sampling frequency",
        "une coupure de {corner:g} Hz : elle doit dépasser 0 et rester sous {nyquist:g} Hz, la "
        "moitié de la fréquence d'échantillonnage",
    ),
    "filter-corners-cross": Message(
        "what is slower than {low:g} Hz and what is faster than {high:g} Hz is taken off: nothing "
        "is left",
        "ce qui est plus lent que {low:g} Hz et ce qui est plus rapide que {high:g} Hz est ôté : "
        "il ne reste rien",
    ),
    "baseline-degree": Message(
        "the degree of a base line is from 1 to 6, not {degree}",
        "le degré d'une ligne de base est entre 1 et 6, pas {degree}",
    ),
    "baseline-points": Message(
        "a record of {n} {n:point|points} has no base line of degree {degree}",
        "un signal de {n} {n:point|points} n'a pas de ligne de base de degré {degree}",
    ),
    "percentile": Message(
        "a percentile is from 0 to 100, not {percentile:g}",
        "un centile est entre 0 et 100, pas {percentile:g}",
    ),
    "target-not-positive": Message(
        "a target spectrum is above zero at all frequencies",
        "un spectre visé est positif à toutes les fréquences",
    ),
    "target-too-fast": Message(
        "the target goes to {frequency:g} Hz, the record's step says nothing above {most:g} Hz",
        "le spectre visé va jusqu'à {frequency:g} Hz, le pas du signal ne dit rien au-delà de "
        "{most:g} Hz",
    ),
    "record-zero": Message(
        "the record is zero everywhere",
        "le signal est nul partout",
    ),
    "record-no-whole-shock": Message(
        "the record has no whole shock",
        "l'enregistrement n'a pas de choc entier",
    ),
}
