"""What ssilang/kernel/materials refuses and warns of."""

from ssilang.messages.message import Message

MESSAGES: dict[str, Message] = {
    "drucker-parfait-ltr-lcs": Message(
        "DRUCKER_PARFAIT has LTR = {tension_min:g} and LCS = {compression_min:g}",
        "DRUCKER_PARFAIT a LTR = {tension_min:g} et LCS = {compression_min:g}",
        "0 < LTR <= LCS (strengths in simple tension and compression)",
        "0 < LTR <= LCS (résistances en traction et en compression simples)",
    ),
    "drucker-prager-needs-beta": Message(
        "DRUCKER_PRAGER needs BETA > 0, MU > 0 and DELT >= 0",
        "DRUCKER_PRAGER demande BETA > 0, MU > 0 et DELT >= 0",
    ),
    "ultimate-cone-drucker-prager": Message(
        "the ultimate cone of DRUCKER_PRAGER has another slope than the first (ETA/MU = "
        "{eta:g}, ALFA/BETA = {alpha:g})",
        "le cône ultime de DRUCKER_PRAGER n'a pas la pente du premier (ETA/MU = {eta:g}, "
        "ALFA/BETA = {alpha:g})",
        "ETA/MU = ALFA/BETA",
        "ETA/MU = ALFA/BETA",
    ),
    "fc-concrete-needs-strength": Message(
        "FC = 0: concrete needs a strength",
        "FC = 0 : le béton veut une résistance",
    ),
    "law-condition": Message(
        "{law} needs {rule}; given {given}",
        "{law} veut {rule} ; il est donné {given}",
    ),
    "clay-cohesion": Message(
        "CAM_CLAY has no cohesion here: COHE = {value:g} must be 0",
        "CAM_CLAY n'a pas de cohésion ici : COHE = {value:g} doit être 0",
        "how a cohesion moves the ellipse is not written in the notice; leave COHE out",
        "la notice ne dit pas comment une cohésion déplace l'ellipse ; omettre COHE",
    ),
    "soft-crack-closing": Message(
        "BETON_UNI closes its cracks at once: FAMX must be < 0, not {value:g}",
        "BETON_UNI referme ses fissures d'un coup : FAMX doit être < 0, et non {value:g}",
        "the gradual closing of cracks (FACL FAM1 FAM2 STPT) is not available; write 'FAMX' -1., "
        "or leave it out",
        "la fermeture progressive des fissures (FACL FAM1 FAM2 STPT) n'est pas disponible ; écrire "
        "'FAMX' -1., ou l'omettre",
    ),
    "slope-and-confinement": Message(
        "BETON_UNI has a slope ZETA and a confinement ALF1 OME1: which of the two says how it "
        "softens?",
        "BETON_UNI a une pente ZETA et un confinement ALF1 OME1 : lequel des deux dit "
        "l'adoucissement ?",
        "write 'ZETA' 0. for the slope that ALF1 and OME1 give, or 'ALF1' 0. with STFC and EZER "
        "of the confined concrete",
        "écrire 'ZETA' 0. pour la pente que donnent ALF1 et OME1, ou 'ALF1' 0. avec STFC et EZER "
        "du béton confiné",
    ),
    "no-plastic-law-bodies": Message(
        "no plastic law of bodies is called {after}",
        "aucune loi plastique de corps ne s'appelle {after}",
        "there are {plastic_laws}",
        "il y a {plastic_laws}",
    ),
    "saturation-sinks": Message(
        "the strength of J2 may not sink: KISO >= 0, VELO >= 0, SIGI >= SIG0",
        "la limite de J2 ne peut pas descendre : KISO >= 0, VELO >= 0, SIGI >= SIG0",
    ),
    "must": Message(
        "{name} = {parameters_min:g}: it must be > 0",
        "{name} = {parameters_min:g} : il faut une valeur > 0",
    ),
    "curve-strengths-not": Message(
        "the curve {name} has strengths that are not > 0",
        "la courbe {name} a des résistances qui ne sont pas > 0",
        "abscissas are plastic strains from 0, ordinates stresses",
        "en abscisses les déformations plastiques à partir de 0, en ordonnées les contraintes",
    ),
    "reduction-no-points": Message(
        "the curve of G/Gmax over the shear strain has no points, or values that are no numbers",
        "la courbe de G/Gmax en fonction de la distorsion est sans points, ou a des valeurs qui ne "
        "sont pas des nombres",
    ),
    "reduction-strain-negative": Message(
        "the curve of G/Gmax begins at the shear strain {strain:g}, below 0",
        "la courbe de G/Gmax commence à la distorsion {strain:g}, au-dessous de 0",
    ),
    "reduction-strains-fall": Message(
        "the shear strains of G/Gmax do not grow: {second:g} follows {first:g}",
        "les distorsions de G/Gmax ne croissent pas : {second:g} suit {first:g}",
    ),
    "reduction-negative": Message(
        "G/Gmax = {ratio:g} at the shear strain {strain:g}: it must be > 0",
        "G/Gmax = {ratio:g} à la distorsion {strain:g} : il faut une valeur > 0",
    ),
    "reduction-begins": Message(
        "G/Gmax begins at {ratio:g}, at the shear strain {strain:g}: it must begin at 1",
        "G/Gmax commence à {ratio:g}, à la distorsion {strain:g} : il doit commencer à 1",
        "give G/Gmax = 1 at a small strain, 1.E-6 say: the soil is elastic up to there",
        "donnez G/Gmax = 1 à une petite distorsion, par exemple 1.E-6 : le sol est élastique "
        "jusque-là",
    ),
    "reduction-rises": Message(
        "G/Gmax rises, from {before:g} at the shear strain {first:g} to {after:g} at {second:g}",
        "G/Gmax monte, de {before:g} à la distorsion {first:g} à {after:g} à {second:g}",
        "the modulus of a soil falls with the strain",
        "le module d'un sol baisse quand la distorsion croît",
    ),
    "reduction-softens": Message(
        "G/Gmax = {ratio:g} at the shear strain {second:g}: the shear stress falls from {first:g} "
        "on",
        "G/Gmax = {ratio:g} à la distorsion {second:g} : la contrainte de cisaillement baisse à "
        "partir de {first:g}",
        "nested surfaces do not soften: end the curve at {first:g}, beyond which the stress stays, "
        "or give at least G/Gmax = {least:.4g}",
        "des surfaces emboîtées n'adoucissent pas : arrêtez la courbe à {first:g}, la contrainte "
        "s'y maintient, ou donnez au moins G/Gmax = {least:.4g}",
    ),
    "reduction-stiffens": Message(
        "G/Gmax = {ratio:g} at the shear strain {strain:g}: the stress G gamma rises faster behind "
        "it than before",
        "G/Gmax = {ratio:g} à la distorsion {strain:g} : la contrainte G gamma monte plus vite "
        "après qu'avant",
        "leave this point out, or give at least G/Gmax = {least:.4g}",
        "ôtez ce point, ou donnez au moins G/Gmax = {least:.4g}",
    ),
    "first-slope-trac-youn": Message(
        "the first slope of TRAC is {slope:g}, YOUN is {young:g}",
        "la première pente de TRAC est {slope:g}, YOUN vaut {young:g}",
        "the second point of TRAC is the elastic limit",
        "le second point de TRAC est la limite élastique",
    ),
    "trac-rises-more-youn": Message(
        "TRAC rises by more than YOUN behind the elastic limit",
        "TRAC monte de plus que YOUN après la limite élastique",
    ),
    "rh-coulomb-needs-cohesion": Message(
        "RH_COULOMB needs a cohesion COHE > 0",
        "RH_COULOMB demande une cohésion COHE > 0",
        "a small one for sand",
        "donnez-en une petite pour un sable",
    ),
    "rh-coulomb-phi": Message(
        "RH_COULOMB has PHI = {phi:g}",
        "RH_COULOMB a PHI = {phi:g}",
        "an angle in radians between 0 and pi/2",
        "donnez un angle en radians entre 0 et pi/2",
    ),
    "norton": Message(
        "NORTON has {name} = {parameters:g}",
        "NORTON a {name} = {parameters:g}",
        "AF1 >= 0, AF2 >= 1 and 0 < AF3 <= 1",
        "il faut AF1 >= 0, AF2 >= 1 et 0 < AF3 <= 1",
    ),
    "elements-family-no-elasticity": Message(
        "elements of the family '{family}' have no elasticity {kind}",
        "les éléments de la famille '{family}' n'ont pas d'élasticité {kind}",
    ),
    "behaviour-joints-only": Message(
        "behaviour {rest} is for joints only",
        "le comportement {rest} est réservé aux joints",
        "give it to joint elements (JOI1 ... JOI8)",
        "donnez-le à des éléments joints (JOI1 ... JOI8)",
    ),
    "plastic-law-bodies-not": Message(
        "the plastic law {rest} is for bodies, not for joints",
        "la loi plastique {rest} est pour les corps, pas pour les joints",
    ),
    "elements-family-no-law": Message(
        "elements of the family '{family}' have no law IMPEDANCE",
        "les éléments de la famille '{family}' n'ont pas de loi IMPEDANCE",
        "it stands on points (POI1) or on lines of two points (SEG2)",
        "elle s'appuie sur des points (POI1) ou des segments à deux points (SEG2)",
    ),
    "impedance-no-law": Message(
        "an impedance has no law {other}",
        "une impédance n'a pas de loi {other}",
        "IMPEDANCE is followed by ELASTIQUE, VOIGT, REUSS or COMPLEXE",
        "IMPEDANCE est suivi de ELASTIQUE, VOIGT, REUSS ou COMPLEXE",
    ),
    "elements-family-not-creep": Message(
        "elements of the family '{family}' do not creep",
        "les éléments de la famille '{family}' ne fluent pas",
        "continuous elements (TRI3 ... CU20, ICQ4 ...) and bars do",
        "les massifs (TRI3 ... CU20, ICQ4 ...) et les barres fluent",
    ),
    "law-creep": Message(
        "which law of creep?",
        "quelle loi de fluage ?",
        "there is FLUAGE {join}",
        "il y a FLUAGE {join}",
    ),
    "creep-goes-elasticity-isotrope": Message(
        "creep goes with elasticity ISOTROPE, not with {elasticity}",
        "le fluage va avec l'élasticité ISOTROPE, pas avec {elasticity}",
    ),
    "elements-family-no-plastic": Message(
        "elements of the family '{family}' have no plastic law {law}",
        "les éléments de la famille '{family}' n'ont pas la loi plastique {law}",
        "fibres of sections (POJS TRIS QUAS) have {fibre_laws}",
        "les fibres de section (POJS TRIS QUAS) ont {fibre_laws}",
    ),
    "elements-family-no-plastic-2": Message(
        "elements of the family '{family}' have no plastic law",
        "les éléments de la famille '{family}' n'ont pas de loi plastique",
        "continuous elements (TRI3 ... CU20, ICQ4 ...), bars and DKT have",
        "les massifs (TRI3 ... CU20, ICQ4 ...), les barres et les DKT en ont",
    ),
    "thin-shells-no-plastic": Message(
        "thin shells have no plastic law {law}",
        "les coques minces n'ont pas la loi plastique {law}",
        "they have {layer_laws}",
        "elles ont {layer_laws}",
    ),
    "plastic-laws-go-elasticity": Message(
        "plastic laws go with elasticity ISOTROPE, not with {elasticity}",
        "les lois plastiques vont avec l'élasticité ISOTROPE, pas avec {elasticity}",
    ),
    "beam-fibres-elastique-section": Message(
        "a beam of fibres is ELASTIQUE SECTION PLASTIQUE SECTION, not {law}",
        "une poutre à fibres est ELASTIQUE SECTION PLASTIQUE SECTION, pas {law}",
        "the laws of the fibres stand in the model of the section",
        "les lois des fibres sont dans le modèle de la section",
    ),
    "poisson-ratio-nu-outside": Message(
        "Poisson's ratio NU = {poisson:g} is outside ]-1, 0.5[",
        "le coefficient de Poisson NU = {poisson:g} est hors de ]-1, 0.5[",
        "{poisson_so_any:?use a value such as 0.49 with an incompressible element (ICQ4, "
        "BBAR) near 0.5|it is a ratio without unit: 0.3 for steel, 0.2 for concrete}",
        "{poisson_so_any:?près de 0.5, prenez 0.49 par exemple, avec un élément "
        "incompressible (ICQ4, BBAR)|c'est un rapport sans unité : 0.3 pour l'acier, 0.2 "
        "pour le béton}",
    ),
    "young-modulus-youn-not": Message(
        "Young's modulus YOUN is not a finite number",
        "le module d'Young YOUN n'est pas un nombre fini",
    ),
    "orthotropic-constants-not-stable": Message(
        "the orthotropic constants are not those of a stable material",
        "les constantes orthotropes ne sont pas celles d'un matériau stable",
        "moduli must be positive and NU12 < (YG1 / YG2) ** 0.5, and so on",
        "les modules doivent être positifs et NU12 < (YG1 / YG2) ** 0.5, de même pour les autres",
    ),
    "direction-orthotropy-normal-shell": Message(
        "the direction of orthotropy is normal to the shell somewhere",
        "la direction d'orthotropie est par endroits normale à la coque",
    ),
    "space-two-vectors-show": Message(
        "in space two vectors show the axes",
        "en dimension 3, les axes se donnent par deux vecteurs",
        "DIRECTION V1 V2",
        "DIRECTION V1 V2",
    ),
    "space-radial-needs-two": Message(
        "in space RADIAL needs two points of the axis",
        "en dimension 3, RADIAL demande deux points de l'axe",
        "RADIAL P1 P2",
        "RADIAL P1 P2",
    ),
    "vectors-axes-zero-parallel": Message(
        "the vectors that give the axes are zero or parallel",
        "les vecteurs qui donnent les axes sont nuls ou parallèles",
    ),
    "trac-begins-zero-stress": Message(
        "TRAC begins at zero stress and strain, then comes the elastic limit",
        "TRAC part de contrainte et déformation nulles, puis vient la limite élastique",
    ),
}
