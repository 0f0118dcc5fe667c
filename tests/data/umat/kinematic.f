C     Von Mises plasticity with linear kinematic hardening (Prager), by
C     the radial return of Simo & Hughes, Computational Inelasticity,
C     box 3.1 without isotropic hardening.
C     PROPS: E, nu, sigma_y, H. STATEV: back stress (NTENS, as a
C     stress), plastic strain (NTENS, engineering shear), equivalent
C     plastic strain.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
      INCLUDE 'aba_param.inc'
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),DDSDDE(NTENS,NTENS),
     1 DDSDDT(NTENS),DRPLDE(NTENS),STRAN(NTENS),DSTRAN(NTENS),
     2 TIME(2),PREDEF(1),DPRED(1),PROPS(NPROPS),COORDS(3),DROT(3,3),
     3 DFGRD0(3,3),DFGRD1(3,3),JSTEP(4)
      DIMENSION XI(6)
      IF (NSTATV.NE.2*NTENS+1) THEN
        CALL STDB_ABQERR(-3,'the state takes %I values, not %I',
     1   (/2*NTENS+1, NSTATV/), (/0.D0/), '        ')
      END IF
      G2 = PROPS(1)/(1.D0 + PROPS(2))
      ALAM = G2*PROPS(2)/(1.D0 - 2.D0*PROPS(2))
      DO I = 1, NTENS
        DO J = 1, NTENS
          DDSDDE(I,J) = 0.D0
          IF (I.LE.NDI .AND. J.LE.NDI) DDSDDE(I,J) = ALAM
        END DO
        IF (I.LE.NDI) DDSDDE(I,I) = ALAM + G2
        IF (I.GT.NDI) DDSDDE(I,I) = G2/2.D0
      END DO
      DO J = 1, NTENS
        DO I = 1, NTENS
          STRESS(I) = STRESS(I) + DDSDDE(I,J)*DSTRAN(J)
        END DO
      END DO
      CALL SINV(STRESS,P,Q,NDI,NSHR)
      DO I = 1, NTENS
        XI(I) = STRESS(I) - STATEV(I)
        IF (I.LE.NDI) XI(I) = XI(I) - P
      END DO
      CALL SINV(XI,DUMMY,Q,NDI,NSHR)
      IF (Q.GT.PROPS(3)) THEN
        DGAMMA = (Q - PROPS(3))/(1.5D0*G2 + PROPS(4))
        DO I = 1, NTENS
          DEP = 1.5D0*DGAMMA*XI(I)/Q
          STRESS(I) = STRESS(I) - G2*DEP
          STATEV(I) = STATEV(I) + PROPS(4)*DEP/1.5D0
          IF (I.GT.NDI) DEP = 2.D0*DEP
          STATEV(NTENS+I) = STATEV(NTENS+I) + DEP
        END DO
        STATEV(2*NTENS+1) = STATEV(2*NTENS+1) + DGAMMA
      END IF
      RETURN
      END
